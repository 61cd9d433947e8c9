#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_result.h"

namespace asperity::app {

struct FeelDemo {
  std::string text;  // the table's rows
  Json json;
  bool trustworthy = true;
  std::string verdict;  // in words, if not
};

// The end of the demonstration: the whole profile of a scan of protoboard as a texture on a flat plate, stroked by the
// modelled hand; the holes' pitch is read back from the force that was rendered. In `folder`/felt: the scene, the
// log, and force.svg. Throws Error if the scan has no profile to make a texture of.
FeelDemo demonstrate_feel(const std::filesystem::path& folder, const ProcessResult& protoboard, double true_pitch_m,
                          const Observer& observer);

}  // namespace asperity::app
