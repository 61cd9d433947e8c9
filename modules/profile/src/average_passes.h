#pragma once

#include <span>
#include <vector>

#include "asperity/profile/profile_pass.h"

namespace asperity {

// A pass on the merge's grid.
struct PassOnGrid {
  const ProfilePass* pass = nullptr;
  std::vector<double> texture_m;  // gaps bridged; 0 beyond its ends
  std::vector<double> slow_m;     // nan where it is not known
  std::vector<char> known;
  std::vector<double> noisier;  // the point's σ over the pass' own; 1 where it is not known
  std::vector<double> frequency_cycles_per_mm, noise_psd_m2_mm;  // as it counts in the mean; empty: not known
};

// The density of the added noise that a pass states; 0 where nothing is known.
double stated_noise_m2_mm(const ProfilePass& pass, double cycles_per_mm);

struct AveragedPasses {
  std::vector<double> texture_m, slow_m;                         // nan where no pass is known
  std::vector<double> sigma_m;                                   // of the added noise
  std::vector<double> frequency_cycles_per_mm, noise_psd_m2_mm;  // of the mean
  std::vector<double> weight;                                    // one a pass, mean over points and bands
};

// The mean in each of a row of bands, weighted by the inverse of the noise in the band and at the point; in a band in
// which the noise of one pass is not known, by that at the point alone.
AveragedPasses average_passes(std::span<const PassOnGrid> passes, double spacing_mm);

}  // namespace asperity
