#pragma once

#include <vector>

#include "asperity/import/stroke.h"

namespace asperity {

// Density of the acceleration over frequency, (m/s²)²/Hz, in motion and in quiet; `noise` is empty if nothing is quiet.
struct VibrationSpectrum {
  std::vector<double> frequency_Hz, density, noise;
};
VibrationSpectrum vibration_spectrum(const Stroke& stroke);

// RMS height in an octave of spatial frequency.
struct StrokeHeightBand {
  double low_cycles_per_mm = 0.0, high_cycles_per_mm = 0.0;
  double rms_m = 0.0;        // noise taken off
  double rms_sigma_m = 0.0;  // its standard error, by the windows' scatter and the quiet's; nan of fewer than two
  double noise_rms_m = 0.0;  // what noise alone would make; 0 if it is not known
  std::size_t windows = 0;   // in which the octave was within the recording's band
};

// The surface's heights as the acceleration shows them: by windows of 0.25 s in which the speed v changes by less than
// a fifth, S_h(f/v) = (S_a(f) − S_quiet(f)) v / (2πf)⁴ between twice the high-pass and 0.4 of the rate. It is the
// surface's only as far as the tip follows the surface, the sensor the tip, and the acceleration is along the normal:
// joined axes have the vibration along the surface in it too. Empty where no speed is known.
struct StrokeHeightSpectrum {
  std::vector<double> cycles_per_mm, density_m2_mm, noise_m2_mm;  // bins of a twelfth of an octave
  std::vector<StrokeHeightBand> octaves;                          // from 1/16 cycles/mm by factors of two
  std::size_t windows = 0;
  bool noise_is_known = false;
};
StrokeHeightSpectrum stroke_height_spectrum(const Stroke& stroke);

}  // namespace asperity
