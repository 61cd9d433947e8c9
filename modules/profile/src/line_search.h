#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Lines in the periodogram of a profile: waves that keep their length over all of it, as a pattern's do. A random
// surface and a hand's tremor have power there too, but spread over neighbouring frequencies. docs/periodicity.md has
// the test, its false-alarm rate and its limits.
//
// The rarity q of an ordinate is the exponent of the probability exp(-q) that a random process has it there. One wave
// is a line if its q is high enough; the first two of a pattern are a pair if the sum T of theirs is. For a random
// process the rarities of two frequencies are independent, so T exceeds a level at one frequency with (1 + T) exp(-T).
class LineSearch {
 public:
  static constexpr double kByChance = 0.01;  // of finding a line in a random surface, or in noise

  // A search among others. It has `share` of the 1 % by which all of them may err. Over directions of ribs, which a
  // path of a bend of b (RMS about its straight line) crosses at the tangents t of a range, ordinates are a random
  // field of two dimensions; `bend_by_range_m` is b times that range, 0 for one direction.
  struct Hypotheses {
    double share = 1.0;
    double bend_by_range_m = 0.0;
  };

  // Heights in m, nan in gaps; the density of the noise in m²/(cycles/mm) at rising frequencies in cycles/mm, empty for
  // none; it may be `most_noise` times as much. Waves of `shortest_m` to `longest_m` are looked for. Of fewer heights
  // than independent frequencies, one to a shortest wave, nothing is a line.
  LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
             std::span<const double> noise_psd_m2_mm, double most_noise, double shortest_m, double longest_m,
             const Hypotheses& hypotheses);
  LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
             std::span<const double> noise_psd_m2_mm, double most_noise, double shortest_m, double longest_m)
      : LineSearch(height_m, spacing_m, frequency, noise_psd_m2_mm, most_noise, shortest_m, longest_m, {}) {}

  // Whether one of the first eight harmonics of a pattern, known to 2 %, is a line, or the first two are a pair: one
  // that a random surface has anywhere in the search with a probability of 1 %, and that holds at least 1/32 of the
  // surface's power (an amplitude of a quarter of its RMS). Harmonics shorter than the shortest wave are not asked.
  bool has_pattern(double pitch_m) const;

  // The length of the wave whose line, of the same kind, holds most power, from `shortest_m` to `longest_m`; without a
  // line that of the first wave of such a pair; 0 if there is none.
  double find_line_m(double shortest_m, double longest_m) const;

  // Of a pattern that is there: whether this harmonic stands out of the noise and of its neighbours, at 1 % for itself.
  bool has_line(double pitch_m, int harmonic) const;

  // Whether a line of this length is the second of a pair, whose first wave a random surface has there, or the noise,
  // with a probability of 1 % at most.
  bool is_second_of_pair(double length_m) const;

  // How many waves down to the shortest pass what is asked of an ordinate by itself. Only these are compared with their
  // neighbours, which takes a fixed number of passes over the heights: at most 158 times the heights with their gaps
  // over those that are present (docs/periodicity-search.md), however long the profile is. Of pairs, at most 64 are.
  std::size_t count_candidates() const;

 private:
  static constexpr std::size_t kPadding = 4;  // bins to an independent frequency
  struct Reach {
    std::size_t first, last;  // bins, the last excluded
  };
  struct Wave {
    double cycles, power;
  };
  struct Rarities {
    double broad = 0.0, narrow = 0.0;  // among many neighbours and among few
    double density = 0.0;              // by the first
  };
  struct Neighbours {
    double nearest, farthest;  // independent frequencies
    bool sides;                // the higher of the two sides counts if it is higher than the fit
  };

  Reach reach_of(double pitch_m, int harmonic) const;
  bool is_rare(double rarity, std::size_t waves, double trials, double bend_cycles) const;
  bool are_rare(const Rarities& rarities, std::size_t waves, const Wave& first) const;
  bool exceeds_noise(std::size_t bin) const;
  bool holds_share(double power) const;
  bool may_be_line(std::size_t bin) const;
  bool is_line(std::size_t bin) const;
  double power_of_pair(std::size_t bin) const { return power_[bin] + power_[2 * bin]; }
  bool may_be_pair(std::size_t bin) const;
  bool is_pair(std::size_t bin, double least_of_first) const;
  std::size_t find_pair(std::size_t first, std::size_t last) const;
  bool is_local_line(std::size_t bin, double near_trials) const;
  double power_at(std::span<const double> heights_m, double cycles) const;
  Wave find_wave(std::size_t bin) const;
  std::vector<double> without_wave(double cycles) const;
  double rarity_among(const Wave& wave, const Neighbours& neighbours, std::span<const double> rest_m,
                      double& density) const;
  Rarities rarities_of(const Wave& wave) const;

  std::vector<double> x_m_;    // heights less their mean, 0 in gaps
  std::vector<bool> present_;  // not in a gap
  double points_ = 0.0;
  double spacing_m_ = 0.0;
  double length_m_ = 0.0;          // of the padded profile: a bin is 1/length
  double searched_ = 0.0;          // independent frequencies up to the shortest wave's
  double trials_ = 0.0;            // of them, those of the search
  std::size_t searched_bins_ = 0;  // bins up to the shortest wave's
  std::vector<double> power_;      // periodogram, m²/(cycles/mm)
  std::vector<double> noise_;      // the most at the same bins
  double most_noise_ = 1.0;        // of what is expected
  Hypotheses hypotheses_;
  double middle_per_m_ = 0.0;  // of the search
  double surface_ = 0.0;       // the periodogram less the noise, summed over independent frequencies
};

}  // namespace asperity
