#pragma once

#include <string>

#include "asperity/pipeline/register_scans.h"

namespace asperity::app {

// What `asperity register` prints of its result: a block a placement (points, residual, pose, what is undetermined),
// then one a scan (length in mm, texture, deviation from the truth where it is known, notes).
std::string register_summary(const ScansOnMesh& result);

}  // namespace asperity::app
