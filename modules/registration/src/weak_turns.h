#pragma once

#include "path_chain.h"

namespace asperity::registration {

// Adds the turns whose standard deviation is above the limit to `result.undetermined`, unless one about nearly the same
// axis is there.
void list_weak_turns(const PathChain& chain, double limit_rad, RegistrationResult& result);

}  // namespace asperity::registration
