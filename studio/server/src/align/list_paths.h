#pragma once

#include "asperity/studio/block.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// What can be laid on a mesh: the project's recordings, and its CSV files with the columns px_m, py_m and pz_m, as
// [{"kind":"recording"|"path","name"}]. Looks three folders deep and into the first 1000 CSV files.
Json list_paths(const Project& project);

}  // namespace asperity::studio
