#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "asperity/verdict/verdict.h"

namespace asperity {

// Real against rendered in one octave.
struct BandAgreement {
  double low_cycles_per_mm = 0.0;
  double high_cycles_per_mm = 0.0;
  double real_rms = 0.0;  // unit of the quantity
  double rendered_rms = 0.0;
  double difference_dB = 0.0;  // 20 log10(rendered / real), within ±40
  bool is_compared = true;     // false: too weak in both to matter
};

// Real against rendered over the whole band.
struct SpectrumAgreement {
  double real_rms = std::numeric_limits<double>::quiet_NaN();
  double rendered_rms = std::numeric_limits<double>::quiet_NaN();
  double rms_ratio = std::numeric_limits<double>::quiet_NaN();    // rendered over real
  double distance_dB = std::numeric_limits<double>::quiet_NaN();  // RMS of the compared octaves' differences
  std::vector<BandAgreement> bands;
};

// How a recorded scan and its rendering agree (check_renderer.h). nan where the scan does not allow a value.
struct RendererCheck {
  double low_cycles_per_mm = 0.0;  // the band of all comparisons
  double high_cycles_per_mm = 0.0;
  double speed_mps = 0.0;   // mean, of the scan
  double compared_m = 0.0;  // length of path that entered
  std::size_t ticks = 0;
  double contact_fraction = 0.0;  // part of the scan's contact in which the renderer was in contact

  bool phase_known = false;   // the texture has the scan's own places, not its spectrum alone
  std::string phase_unknown;  // why not, in words
  double correlation = std::numeric_limits<double>::quiet_NaN();  // of the heights, after one rigid shift
  double gain = std::numeric_limits<double>::quiet_NaN();         // slope of rendered on real heights
  double shift_m = 0.0;
  double distribution_distance = std::numeric_limits<double>::quiet_NaN();  // of the heights, in real RMS heights
  SpectrumAgreement height;                                                 // m
  SpectrumAgreement force;           // N, along the normal: what the texture adds, against what the real heights would
  SpectrumAgreement measured_force;  // N: rendered against measured; reported, not judged

  double height_score = 0.0;  // each from 0 to 1 (check_renderer.h)
  double force_score = 0.0;
  double score = 0.0;
  std::string comparison;   // what was compared, in words with the values
  Verdicts verdicts;        // judge_rendering.h
  bool trustworthy = true;  // none is invalid
};

}  // namespace asperity
