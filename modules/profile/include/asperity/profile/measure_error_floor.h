#pragma once

#include <span>

namespace asperity {

// The floor of an acceleration's spectrum, (m/s²)²/Hz, one-sided: the lowest of the mean densities of its octaves, from
// half the sampling rate down to 12 Hz. White noise of whatever source (the sensor's, rounding, and what folds about
// the sampling rate) is not above it, whereas a texture's acceleration rises towards high frequencies and a contact's
// falls off beyond its resonance. Taken over runs of samples with `usable` set (empty: all) without a missing one.
// 0 if there is no run of 0.16 s, or none of 32 samples.
double acceleration_floor_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2,
                                std::span<const char> usable);

// The density that folds about the sampling rate to low frequencies, (m/s²)²/Hz, one-sided: what is beyond half the
// sampling rate is not seen, but the spectrum's fall over the highest octave, continued for another, says how large it
// still is at the sampling rate itself. Where it does not fall it is that at half the rate. 0 as above.
double folded_acceleration_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2,
                                 std::span<const char> usable);

// The noise of lost samples, (m/s²)²/Hz, one-sided: over a gap the acceleration is a straight line, and the velocity's
// error is that of the line's integral. Gaps of the same lengths in stretches without one show how large it is; errors
// of velocity that come at random are white noise of acceleration, 2 Σ Δv²/T. `replaced` samples in all of `t_s`, whose
// value became their neighbours' mean, count as gaps of one.
double gap_noise_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2, std::span<const char> usable,
                       std::size_t replaced);

// The largest white noise of acceleration, (m/s²)²/Hz, that a position smoothed from it and from a tracker's noise of
// density `tracker_psd_m2ps` can have had: its error A R/(A + R (2πf)⁴) cannot exceed the density that the position has
// itself, in any octave from 1.6 to 50 Hz. That density is known from few ordinates (χ², each octave's upper limit is
// wrong in 1 % of cases). Where (2πf)⁴ R is small compared with A the error is R, whatever A is: such octaves bound
// nothing. `tracker_psd_m2ps` must therefore be no larger than it may be. `position_m` may be a height or what is
// travelled less its line. Infinite where the position is nowhere quieter than the tracker, or shorter than two
// stretches of 1.3 s.
double largest_acceleration_noise_m2ps3(std::span<const double> t_s, std::span<const double> position_m,
                                        std::span<const char> usable, double tracker_psd_m2ps);

}  // namespace asperity
