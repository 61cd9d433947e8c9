#pragma once

#include <cstddef>
#include <span>

#include "asperity/base/config.h"
#include "asperity/signal/spectrum.h"

namespace asperity {

struct SpectrumConfig {
  double segment_m = 25.6e-3;

  template <class V>
  void visit(V& v) {
    v.field("segment_m", segment_m, "length of the stretches that are averaged", {1e-6, 100.0});
  }
};

// The power spectrum of a uniform profile (m, nan in gaps), in cycles/mm and m²/(cycles/mm): Welch's estimate
// (spectrum.h) of each stretch without gaps, averaged by their number of segments. Segments are as long as the
// settings say, or as the longest stretch if that is shorter; shorter stretches do not count. Empty if no stretch has
// 16 points. Throws Error for a spacing that is not positive.
PowerSpectrum measure_spectrum(std::span<const double> height_m, double spacing_m, const SpectrumConfig& config = {});

}  // namespace asperity
