#pragma once

#include <string>
#include <vector>

#include "asperity/recording/inspect_recording.h"

namespace asperity {

// Sentences on what looks wrong in the figures of an inspection.
std::vector<std::string> find_findings(const Recording& recording, const Inspection& inspection,
                                       const InspectConfig& config);

}  // namespace asperity
