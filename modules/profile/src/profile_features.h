#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/base/progress.h"

namespace asperity {

// The stretches of samples between gaps, in order.
std::vector<std::span<const double>> gap_free_stretches(std::span<const double> height_m);

struct ElementWidths {
  double sum_m = 0.0;
  std::size_t count = 0;
  double sum_height_m = 0.0;  // of each one's hill and pit together
  double highest_m = 0.0;
  double sum_square_m2 = 0.0;  // of the widths
  double widest_m = 0.0;
  double sum_square_height_m2 = 0.0;  // of the heights

  void add(const ElementWidths& more);
};

// Widths and heights of the profile elements of one gap-free stretch: from each significant crossing of the mean
// line to the next but one, so that hill–pit and pit–hill count alike and a reversed profile gives the
// same. Hills and pits lower than `min_height_m`, then those narrower than `min_width_m`, are taken
// into their neighbours.
ElementWidths element_widths(std::span<const double> stretch_m, double spacing_m, double min_height_m,
                             double min_width_m, const Observer& observer = {});

struct PeaksAndPits {
  std::vector<double> peak_m;
  std::vector<double> pit_m;             // heights, most of them negative
  std::vector<const double*> peak, pit;  // their samples in the stretch
};

// The peaks that stand out from the pits on both sides by at least `prominence_m`, and the pits that do
// the same downwards (Wolf pruning); extremes that an end cuts off are not counted.
void append_peaks_and_pits(std::span<const double> stretch_m, double prominence_m, PeaksAndPits& found,
                           const Observer& observer = {});

}  // namespace asperity
