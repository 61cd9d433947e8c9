#pragma once

#include <cstddef>
#include <vector>

#include "asperity/pipeline/register_scans.h"

namespace asperity {

// The lines of the mesh that recorded scans are over more than once (shared_lines.h), each merged (merge_line) with its
// passes in the mesh's frame; the scans of a merge that was laid are measured again with the heights that it gave them.
// They are returned, rising. Adds `lines`, and the verdicts over what the passes show of the stated noise, to `result`.
std::vector<std::size_t> merge_scans(const std::vector<Scan>& scans, const RegisterConfig& config, ScansOnMesh& result);

}  // namespace asperity
