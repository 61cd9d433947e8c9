#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace asperity {

// The regular clock behind time stamps that scatter.
struct SampleClock {
  double period_ns = 0.0;
  std::vector<double> count;  // periods since the first sample, one for each stamp, strictly rising
};

// Finds the period at which the stamps keep their phase, and counts the periods between them.
// With single stamps that are late by an error τ, the sum C = Σ exp(2πi t/T) over n stamps has |C|² ≈ n² exp(−(2πσ/T)²)
// at the true period T, whichever samples are lost, and n at any other. The mean over blocks of stamps is compared with
// that of random phases (Chernoff's bound for a sum of exponential variables, one in a thousand). Stamps in whole ticks
// of a host's clock have a second such period by aliasing: the longest one that the mean step allows is taken, for
// losses make the mean step longer, never shorter.
// The counts are those nearest to the stamps (least squares) of all that rise by one or more from stamp to stamp: an
// isotonic regression. A late stamp is not taken for a lost sample, unless the next ones stay late.
// `t_ns` rises strictly. Nothing for fewer than 20 stamps, or where no period is that clear.
std::optional<SampleClock> find_sample_clock(const std::vector<std::int64_t>& t_ns);

}  // namespace asperity
