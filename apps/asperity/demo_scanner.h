#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_config.h"

namespace asperity::app {

struct ScannerDemo {
  std::string text;  // the table's rows
  Json json;
  bool trustworthy = true;
  std::string verdict;  // in words, if not
};

// The scanner, end to end on the virtual bench: a camera is calibrated from rendered boards, the tracker's noise, the
// force sensor, the accelerometer, the tip and the latency from what the rendered and played probe gives, and with that
// calibration a live scan of the protoboard is recorded and processed. Every figure against the bench's truth. In
// `folder`: boards/, calibration.json, shaken/, scan/, result/.
ScannerDemo demonstrate_scanner(const std::filesystem::path& folder, const ProcessConfig& process,
                                const Observer& observer);

}  // namespace asperity::app
