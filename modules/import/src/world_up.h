#pragma once

#include <string>

#include "asperity/import/import_mapped.h"

namespace asperity {

// The axis of the files' world that points up, as it is stated or known of the program; "" if neither.
std::string up_of(const ImportTables& tables, const MappingConfig& config);

// Rotates the poses so that z points up: by that axis, else by the one that the mean specific force is within 5° of,
// else by its direction itself. Where a check has failed, a stated axis is used as it is, and what is estimated is an
// assumption, of the nearest axis within 20°. A stated axis that is further off is a doubt, beyond 5° a note.
void find_up(const ImportTables& tables, const MappingConfig& config, ImportedMotion& motion);

}  // namespace asperity
