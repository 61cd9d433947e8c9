#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/recording/recording.h"

namespace bench {

// One scan of known truth, and what is known of the object besides.
struct ScanCase {
  std::uint64_t seed = 0;
  std::string family;                   // of surfaces
  std::string probe;                    // "open" or "what"
  std::vector<std::string> conditions;  // what else is worth telling apart: "batches", "tracker drift", …
  asperity::Recording recording;
  bool nothing = false;                                                  // nothing was touched
  double pitch_m = std::numeric_limits<double>::quiet_NaN();             // of a periodic surface
  double stiffness_N_per_mm = std::numeric_limits<double>::quiet_NaN();  // of the contact, at the mean force
};

enum class CasePaths { kDrawn, kCurved, kRaster };

// What a coverage run draws from. `families` and `probes`: empty for all.
struct CaseChoice {
  std::vector<std::string> families, probes;
  bool exact_calibration = false;
  CasePaths paths = CasePaths::kDrawn;  // the second simulator has straight ones alone
};

// Random scans of the product's own virtual bench. The same seed and choice give the same scan. Throws asperity::Error
// for a family that it does not have.
ScanCase simulate_own_case(std::uint64_t seed, const CaseChoice& choice);
const std::vector<std::string>& own_families();

// The same of the second simulator (second_bench/), through the files that it writes.
ScanCase simulate_second_case(std::uint64_t seed, const CaseChoice& choice);

}  // namespace bench
