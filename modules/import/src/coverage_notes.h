#pragma once

#include <string>
#include <vector>

#include "asperity/import/import_mapped.h"

namespace asperity {

// What of poses, sensor and force has no counterpart in time, a sentence each with its seconds: more than 0.1 s and a
// hundredth. The streams are on one clock. Throws Error where the force is at none of the times that poses and sensor
// have in common.
std::vector<std::string> coverage_notes(const ImportTables& tables, const ImportStreams& streams);

}  // namespace asperity
