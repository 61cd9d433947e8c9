#pragma once

#include <span>

#include <Eigen/Core>

#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// find_periodicity() of what a noisy profile is of: the depth without what noise adds to the highest less the lowest
// point of a period, and standard errors of the measurement of this stretch.
// A pattern has a line: one of its first eight harmonics, or the first two together, stand out of the noise and of
// their neighbours in the periodogram, as a random surface's do in one of a hundred profiles (docs/periodicity.md);
// without one it is not periodic.
//
// The depth is followed over added noise as the roughness is (measure_roughness_under_noise.h), at the pitch that was
// found; in its error are the draws' spread, the extrapolation's doubt, that of the noise's power and
// `noise.scale_sigma`, and noise of the contact. The pitch's error has `noise.along_sigma` added: an error of the
// length that phases cannot show. Without a noise it is find_periodicity(), whose depth's error is that of a median
// over unlike periods.
Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config);

// The same where the points of the profile are known in a plane (unroll_path.h; m, one for each height, or none).
// Straight ribs that a bent path crosses at a changing angle have periods that change along it. Where the bend is more
// than 1/50 of the length and no pattern is found along the path, the heights are searched along the normal of ribs in
// each direction up to 45° off the chord, at the same false-alarm rate for all directions together. The pitch is then
// the mean along the path, with the spread of the local period in its error, and `across_pitch_m` that across the ribs.
// Throws Error if there are points and not one for each height.
Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config, std::span<const Eigen::Vector2d> unrolled_m);

}  // namespace asperity
