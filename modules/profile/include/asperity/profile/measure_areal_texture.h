#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "asperity/base/areal_map.h"
#include "asperity/profile/areal_noise.h"
#include "asperity/profile/areal_parameters.h"

namespace asperity {

enum class ArealForm { kMean, kPlane, kQuadric };
inline constexpr std::array<std::string_view, 3> kArealFormNames{"mean", "plane", "quadric"};

enum class ArealFilter { kGaussian, kRobust };
inline constexpr std::array<std::string_view, 2> kArealFilterNames{"gaussian", "robust"};

struct ArealTextureConfig {
  ArealForm form = ArealForm::kPlane;
  ArealFilter filter = ArealFilter::kGaussian;
  double lambda_s_mm = 0.0;
  double lambda_c_mm = 0.0;
  double max_missing = 0.5;

  template <class V>
  void visit(V& v) {
    v.choice("form", form, kArealFormNames,
             "F-operation: subtracts the mean, the least-squares plane, or the least-squares quadric");
    v.choice("filter", filter, kArealFilterNames,
             "L-filter: Gaussian (ISO 16610-61), or robust Gaussian regression (ISO 16610-71)");
    v.field("lambda_s_mm", lambda_s_mm, "S-filter: Gaussian low-pass (ISO 16610-61) that keeps noise out; 0: none",
            {0.0, 1000.0});
    v.field("lambda_c_mm", lambda_c_mm, "L-filter: high-pass that removes waviness; 0: none", {0.0, 1000.0});
    v.field("max_missing", max_missing, "largest part of the heights that may be nan", {0.0, 1.0});
  }
};

struct ArealTextureResult : ArealParameters {
  ArealParameters standard_error;  // nan where not known
  double slope_x = 0.0;            // in the middle, of the form that was removed
  double slope_y = 0.0;
  std::size_t samples = 0;
  std::size_t missing = 0;
};

// The surface that the parameters are of: less its form, S-filtered, L-filtered, of mean zero; nan where missing.
// Throws Error as measure_areal_texture() does.
ArealMap filter_surface(const ArealMap& map, const ArealTextureConfig& config = {});

// The areal parameters of a map. Missing heights take part in nothing. With a noise that is known each value has its
// standard error: the spread of draws of that noise added to the heights before the filters, together with what noise
// has changed the value by, found by simulation and extrapolation (measure_roughness_under_noise.h). The values are
// those of the heights as they are. Throws Error unless the map has at least 2×2 points and both spacings, every height
// is finite or nan, the missing part is small enough, and the present points fix the form.
ArealTextureResult measure_areal_texture(const ArealMap& map, const ArealTextureConfig& config = {},
                                         const ArealNoise& noise = {});

}  // namespace asperity
