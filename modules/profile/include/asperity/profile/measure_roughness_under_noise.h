#pragma once

#include <span>

#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// The roughness of what a noisy profile is of, and its standard errors (docs/texture-noise.md): the parameters that
// `height_m` would have without its noise.
//
// Noise of the spectrum `noise.added_psd_m2_mm` is added to the heights, once and twice its power, in a number of draws
// with a fixed seed; each parameter's mean is followed over the power λ of the noise, 0, 1, 2, by a parabola, and this
// gives its value at λ = −1 (simulation and extrapolation: Cook and Stefanski, J. Am. Stat. Assoc. 89, 1994). Lengths
// are followed by their squares, which grow evenly with the power; Rq² is less by exactly the noise's power. Value and
// standard error of a height are those of a length ≥ 0 whose square was measured so, also where that is small or
// negative. Rsk and Rku are divided by powers of the surface's share of the mean square, as cumulants add
// (shape_without_noise.h), and are nan where that share is not above 0 by two of its standard errors. RSm is not
// determined, nan, where the texture hardly stands out of its noise (`noise.measured_snr_low` or `noise.snr` below 1).
//
// The standard error is of the measurement of this stretch, not of the surface's other places. In it are the spread of
// the draws, half of what parabola and straight line differ by (half of the
// correction for parameters that hang on single heights), the correction times the relative error of the noise's
// power, for heights `contact_rms_m` over √3 as a relative error and for Ra and Rq half of
// `stretch_sigma`, for parameters that hang on single heights what misplaced ones can do (`noise.misplaced_psd_m2_mm`:
// the spread over draws and half of their mean change, which is not corrected), `scale_sigma` (relative, of all
// heights) and, for RSm, `along_sigma` (relative, of lengths along the path) and what one standard error of Rz changes
// about which elements count. Without a noise (empty) the values are
// the measured ones, their errors nan. Throws Error as measure_roughness() does.
RoughnessResult measure_roughness_under_noise(std::span<const double> height_m, double spacing_m,
                                              const TextureNoise& noise, const RoughnessConfig& config = {});

}  // namespace asperity
