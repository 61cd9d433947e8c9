#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/profile/roughness.h"

namespace asperity {

enum class ProfileForm { kMean, kLine };
inline constexpr std::array<std::string_view, 2> kProfileFormNames{"mean", "line"};

enum class ProfileFilter { kGaussian, kRobust };
inline constexpr std::array<std::string_view, 2> kProfileFilterNames{"gaussian", "robust"};

enum class ProfileEnds { kKeep, kCut };
inline constexpr std::array<std::string_view, 2> kProfileEndsNames{"keep", "cut"};

struct RoughnessConfig {
  ProfileForm form = ProfileForm::kMean;
  double lambda_s_mm = 0.0;
  double lambda_c_mm = 0.0;
  double lambda_f_mm = 0.0;
  ProfileFilter filter = ProfileFilter::kGaussian;
  ProfileEnds ends = ProfileEnds::kKeep;
  int sections = 5;
  double element_height = 0.10;
  double element_width = 0.01;
  double peak_prominence = 0.05;
  double max_missing = 0.5;

  template <class V>
  void visit(V& v) {
    v.choice("form", form, kProfileFormNames, "what is subtracted first: the mean, or the least-squares line");
    v.field("lambda_s_mm", lambda_s_mm, "Gaussian low-pass (ISO 16610-21) that keeps noise out; 0: none",
            {0.0, 1000.0});
    v.field("lambda_c_mm", lambda_c_mm, "high-pass that removes waviness; 0: none", {0.0, 1000.0});
    v.field("lambda_f_mm", lambda_f_mm, "longer waves than this leave the waviness profile (W); 0: none leave it",
            {0.0, 1000.0});
    v.choice("filter", filter, kProfileFilterNames,
             "of λc and λf: Gaussian (ISO 16610-21), or robust Gaussian regression (ISO 16610-31)");
    v.choice("ends", ends, kProfileEndsNames,
             "keep: filtered up to the ends (ISO 16610-28); cut: half a cut-off length is left out at either end");
    v.field("sections", sections, "equal sections that Rz is the mean over", {1, 1000});
    v.field("element_height", element_height, "RSm: hills and pits below this part of Rz are not counted", {0.0, 1.0});
    v.field("element_width", element_width, "RSm: hills and pits below this part of a section are not counted",
            {0.0, 1.0});
    v.field("peak_prominence", peak_prominence, "R5p, R5v: least prominence of a peak, as a part of Rz", {0.0, 1.0});
    v.field("max_missing", max_missing, "largest part of the heights that may be nan", {0.0, 1.0});
  }
};

// The roughness profile that measure_roughness() takes its parameters of: `height_m` (uniform,
// `spacing_m` apart, nan where missing) less its form, then low-passed by λs and high-passed by λc,
// its mean zero. Throws Error as measure_roughness() does.
std::vector<double> roughness_profile_m(std::span<const double> height_m, double spacing_m,
                                        const RoughnessConfig& config = {});

// Roughness parameters of a profile of heights `spacing_m` apart (ISO 21920-2:2021, for Rz and RSm in
// the reading of ISO 4287:1997; docs/roughness.md says which follows which). nan heights are missing:
// no profile element, peak or pit spans them, and a section that lacks more than `max_missing` of its
// samples is left out of Rz. Throws Error for a spacing that is not positive, an infinite height, fewer
// than two samples a section, or too many missing heights; Cancelled, where heights are filtered between two Fourier
// transforms of the profile.
RoughnessResult measure_roughness(std::span<const double> height_m, double spacing_m,
                                  const RoughnessConfig& config = {}, const Observer& observer = {});

// Rcm(p): how far the level at which `percent` of the present samples are material lies above the
// highest one (never positive). Levels are sample heights, not interpolated (ISO 21920-2, annex C).
// Throws Error outside 0 to 100 or without a height.
double inverse_material_ratio_m(std::span<const double> height_m, double percent);

}  // namespace asperity
