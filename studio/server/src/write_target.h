#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/output.h"
#include "asperity/studio/calls.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// Where a call's "name" is in the project, to be written there. Throws Advice if something is there already and the
// call does not say "replace": true; and Error as Project::writable does.
std::filesystem::path write_target(const Project& project, const Request& request);

// Puts the folder in place; every window receives the names of files that others put there meanwhile, and that were
// kept. Any thread.
void put_in_place(OutputFolder& folder, const std::string& name, Hub& hub);

}  // namespace asperity::studio
