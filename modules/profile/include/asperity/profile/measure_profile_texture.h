#pragma once

#include <optional>
#include <span>

#include "asperity/profile/filter_profile.h"
#include "asperity/profile/profile_parameters.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

struct MaterialRatioConfig {
  double level_um = 0.0;
  double upper_ratio = 0.1;
  double lower_ratio = 0.9;

  template <class V>
  void visit(V& v) {
    v.field("level_um", level_um, "level c of the material ratio mr, from the mean line", {-1e7, 1e7});
    v.field("upper_ratio", upper_ratio, "dc is the curve's fall from this material ratio", {0.0, 1.0});
    v.field("lower_ratio", lower_ratio, "to this one", {0.0, 1.0});
  }
};

// Parameters of a profile of mean zero (FilteredProfiles) that is divided into `sections` for p, v, z and zx. Of the
// config: discrimination of profile elements, `max_missing` of a section. Throws Error if there are fewer than two
// heights.
ProfileParametersResult measure_profile_parameters(std::span<const double> z_m, double spacing_m, int sections,
                                                   const RoughnessConfig& config = {},
                                                   const MaterialRatioConfig& material = {});

// The parameters of P, R and W. P and W have one section, their whole length; R those of the config.
struct ProfileTexture {
  ProfileParametersResult P;
  std::optional<ProfileParametersResult> R;  // with λc
  std::optional<ProfileParametersResult> W;  // with λc, where the profile is long enough
};

// The three of heights `spacing_m` apart. With a noise (`noise.added_rms_m` > 0) each value has its standard error: the
// spread of draws of that noise added to the heights before the filters, together with what noise has changed the value
// by, found by simulation and extrapolation (measure_roughness_under_noise.h). The values are those of the heights as
// they are. Throws Error as filter_profile() does.
ProfileTexture measure_profile_texture(std::span<const double> height_m, double spacing_m,
                                       const RoughnessConfig& config = {}, const MaterialRatioConfig& material = {},
                                       const TextureNoise& noise = {});

}  // namespace asperity
