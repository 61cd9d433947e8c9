#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/nan.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

enum class TipMode { kOff, kErode };
inline constexpr std::array<std::string_view, 2> kTipModeNames{"off", "erode"};

struct TipConfig {
  TipMode mode = TipMode::kOff;
  double radius_m = 0.0;

  template <class V>
  void visit(V& v) {
    v.choice("mode", mode, kTipModeNames, "erode: the surface under the tip and where the tip touched it");
    v.field("radius_m", radius_m, "of the tip; 0: the calibration's", {0.0, 0.1});
  }
};

// The surface under the tip's heights.
struct ErodedProfile {
  bool determined = false;
  std::string reason;              // why not
  double radius_m = kNan;          // of the tip
  std::vector<double> surface_m;   // one a point; nan in gaps
  std::vector<char> touched;       // one a point: tip_morphology.h
  double touched_share = kNan;     // of the points with a height
  double correction_rms_m = kNan;  // of the tip's height less the surface's, less its mean
  double noise_rms_m = kNan;       // of what noise does to the surface
  double bias_m = kNan;            // mean of it: taken off
};

// The surface under `profile.height_m` by the erosion with a ball of `radius_m`, points within two spacings as one
// (tip_morphology.h). Noise makes an erosion too low, for it takes the lowest of several heights: draws of noise with
// the shape of `noise.added_psd_m2_mm` and the power of `noise.noise_rms_m` are added to the heights and eroded, and
// their mean difference is taken off. Not determined where what noise does, its mean and the heights' own noise
// included, is as large as the correction. Without a noise nothing is taken off. Throws Error as erode_by_tip() does.
ErodedProfile erode_profile(const Profile& profile, const TextureNoise& noise, double radius_m);

}  // namespace asperity
