#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "scan_case.h"

namespace bench {

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// One figure of one scan, measured beside true.
struct FigureOutcome {
  std::string name;
  double value = kMissing, low = kMissing, high = kMissing;  // what the product says, with its 95 % interval
  double truth = kMissing;
  double oracle_sigma = kMissing;  // of one who knows the noise's own spectrum; see judge_case.cc
  double told_sigma = kMissing;    // of a pattern's figure: of one who also knows the maker's pitch
  bool has_value() const { return value == value; }
  bool determined() const { return low == low || high == high; }  // an interval, at least on one side
  bool holds() const { return !(truth < low) && !(truth > high); }
};

// Edges of the bands in which the texture's error is looked at, cycles/mm.
inline constexpr std::array<double, 7> kBandEdges{0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0};
inline constexpr std::size_t kBands = kBandEdges.size() - 1;

// What the product made of one scan.
struct ScanOutcome {
  std::uint64_t seed = 0;
  std::string family, probe;
  std::vector<std::string> conditions;
  bool failed = false;            // no result at all
  bool trusted = false;           // nothing invalid: exit code 0
  bool nothing = false;           // nothing was touched, or glass
  bool has_pattern = false;       // the surface, by its maker
  bool pattern_said = false;      // the result
  bool oracle_pattern = false;    // of a surface without one: the oracle of the pitch has one
  double correlation = kMissing;  // r: docs/profile.md's comparison
  double position_over_sigma = kMissing, height_over_sigma = kMissing, texture_over_sigma = kMissing;
  double position_rms_m = kMissing, texture_error_m = kMissing, texture_rms_m = kMissing;  // RMS of error, and true
  std::array<double, kBands> error_m{}, said_m{}, surface_m{};  // RMS in each band: actual error, said noise, truth
  double process_s = 0.0;
  double noise_rms_m = kMissing, snr = kMissing, snr_low = kMissing;  // what the product says of the texture
  double expected_correlation = kMissing, stretch_correlation = kMissing;
  std::string codes;  // of its verdicts but notes, "invalid:… limited:…"
  std::vector<FigureOutcome> figures;
};

// Processes the scan with the product's defaults and compares it with its truth.
ScanOutcome judge_case(const ScanCase& scan);

// The names of all figures, in the tables' order.
std::vector<std::string> figure_names();

}  // namespace bench
