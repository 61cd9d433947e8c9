#pragma once

#include <cstddef>
#include <vector>

#include "asperity/base/nan.h"

namespace asperity {

// The power spectrum of a surface along a profile, one-sided, with its 95 % intervals (measure_surface_spectrum.h).
struct SurfaceSpectrum {
  std::vector<double> frequency_cycles_per_mm;
  std::vector<double> density_m2_mm;  // of the surface: as measured less the added noise, 0 where that is negative
  std::vector<double> low_m2_mm;      // ends of the interval; nan where the noise is not known
  std::vector<double> high_m2_mm;
  std::vector<double> noise_m2_mm;  // what was taken off; nan where it is not known
  std::size_t segments = 0;         // averaged
  double freedom = kNan;            // degrees of freedom of a density, but for those at both ends of the band

  std::size_t size() const { return frequency_cycles_per_mm.size(); }
};

}  // namespace asperity
