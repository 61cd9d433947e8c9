#pragma once

#include <optional>

#include "asperity/profile/estimate_compliance.h"

namespace asperity {

// The contact stiffness that goes with a compliance coefficient.
struct ChartedStiffness {
  double stiffness_N_per_mm = 0.0;  // at which k_c is the median
  double low_N_per_mm = 0.0;        // 95 %: at which k_c is still among the usual ones
  double high_N_per_mm = 0.0;       // infinite where k_c occurs on rigid surfaces too
};

// Reads the chart of docs/compliance.md backwards: k_c of scans on the virtual bench over the contact's stiffness from
// 1 to 200 N/mm (median and 95 % of single strokes of 80 mm, random reliefs, tip of 0.32 mm radius), straight between
// its points in ln(stiffness). What lies beyond the chart's ends is given as its ends. nullopt if k_c is not
// determined.
std::optional<ChartedStiffness> stiffness_of_compliance(const Compliance& compliance);

}  // namespace asperity
