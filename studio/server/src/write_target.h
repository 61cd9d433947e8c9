#pragma once

#include <filesystem>

#include "asperity/studio/calls.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// Where a call's "name" lies in the project, to be written there. Throws Advice if something is there already and the
// call does not say "replace": true; and Error as Project::writable does.
std::filesystem::path write_target(const Project& project, const Request& request);

}  // namespace asperity::studio
