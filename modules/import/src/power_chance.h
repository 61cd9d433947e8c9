#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Powers of windows of one length, with the windows' first samples.
struct WindowPowers {
  std::size_t length = 0;
  std::vector<std::size_t> first;
  std::vector<double> power;
};

// The chance that two groups of windows of the same noise differ in power as `active` exceeds `quiet`, or more
// (measure_stroke_evidence.h). 1 where it does not; 0 for a quiet that is silent.
double power_chance(const WindowPowers& active, const WindowPowers& quiet);

// The same against a power that is known.
double power_chance(const WindowPowers& active, double noise_power);

// The chance that the louder half of `windows` windows of Gaussian noise has `ratio` times the power of the `quietest`
// quietest ones, or more; the windows' powers have `freedom` degrees of freedom.
double quietest_chance(double ratio, std::size_t windows, std::size_t quietest, double freedom);

// The degrees of freedom of the power of `window_s` of Gaussian noise with the spectrum of `x`.
double power_freedom(std::span<const double> x, double rate_Hz, double window_s);

}  // namespace asperity
