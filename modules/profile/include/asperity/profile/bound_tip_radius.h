#pragma once

#include <string>

#include "asperity/base/nan.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// What heights alone show of the radius of the tip that measured them: no more than an upper bound.
struct TipRadiusBound {
  bool determined = false;
  std::string reason;             // why not
  double at_most_m = kNan;        // the radius is not larger, 97.5 %
  double at_s_m = kNan;           // arc length of the sharpest peak
  double smoothing_m = kNan;      // standard deviation of the Gaussian through which it is seen
  double curvature_per_m = kNan;  // of the peak there, and its standard deviation
  double curvature_sigma_per_m = kNan;
};

// Blind estimation of a ball's radius (Villarrubia, J. Res. NIST 102, 1997, §6), with the noise counted.
//
// Heights of a ball of radius R are the highest of caps of that radius: no peak is sharper than the ball. With the
// slope p = h′ that is h″ ≥ −(1 + p²)^{3/2}/R, and a mean of such heights with positive weights has it too. So for
// every smoothing g ≥ 0
//
//   R ≤ (1 + p_most²)^{3/2} / max over x of −(g ∗ h)″(x)
//
// with p_most the steepest slope of h under g. A surface without a peak that is sharper than the ball gives a bound
// that is larger than R: a lower bound does not exist, for a blunt surface and a blunt tip are the same heights.
//
// Without counting the noise the bound is too low, for the sharpest of many noisy peaks is one of the noise (Dongmo et
// al., Ultramicroscopy 85, 2000; Tian, Qian and Villarrubia, ibid. 2008: thresholds by hand). Here (g ∗ h)″ has the
// variance σ² = ∫ (2πf)⁴ |G(f)|² N(f) df by the stated density N, and the curvature of each point counts less z σ,
// z the normal quantile of 2.5 % over the number of independent points and of the Gaussians g that are tried (standard
// deviations of 25 to 400 µm). `noise` at its largest (97.5 %), and as large at each point as its added_sigma_m is over
// the mean.
//
// Not determined without a noise, or where no peak stands out of it. Of `profile`, height_m as measured, no noise
// removed. The heights are of a tip that stays in contact.
TipRadiusBound bound_tip_radius(const Profile& profile, const TextureNoise& noise);

}  // namespace asperity
