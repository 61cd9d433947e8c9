#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Lines in the periodogram of a profile: waves that keep their length over all of it, as a pattern's do. A random
// surface and a hand's tremor have power there too, but spread over neighbouring frequencies.
//
// The periodogram of Gaussian noise over its density exceeds q with the probability exp(−q); over the median of m
// independent neighbours, which scatters as χ² with about m degrees of freedom, with (1 + 2q/m)^(−m/2). A line exceeds
// both, at one in a hundred for all that is searched together; of the neighbours the higher side counts.
class LineSearch {
 public:
  // Heights in m, nan in gaps; the density of the noise in m²/(cycles/mm) at rising frequencies in cycles/mm. A search
  // looks at as many frequencies as the profile is `shortest_m` long.
  LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
             std::span<const double> noise_psd_m2_mm, double shortest_m);

  // Whether the pattern's harmonic is a line, looked for as far as the pitch may be off (2 %).
  bool has_line(double pitch_m, int harmonic) const;

  // The length of the wave whose line holds most power, from `shortest_m` to `longest_m`; 0 if there is no line.
  double find_line_m(double shortest_m, double longest_m) const;

 private:
  // Among so many frequencies for noise, and for what the neighbours have.
  bool is_line(std::size_t bin, double trials, double near_trials) const;

  double length_m_ = 0.0;      // of the padded profile: a bin is 1/length
  double searched_ = 0.0;      // frequencies
  std::vector<double> power_;  // periodogram, m²/(cycles/mm)
  std::vector<double> noise_;  // at the same bins
};

}  // namespace asperity
