#pragma once

#include "asperity/live/scan_hints.h"

namespace asperity {

struct ScanHintFacts {
  double value = 0.0;
  double highest_speed_mps = 0.0;
  const ScanHintsConfig& config;
};

// A hint's severity, numbers and sentences.
Hint describe_hint(HintKind kind, const ScanHintFacts& facts);

}  // namespace asperity
