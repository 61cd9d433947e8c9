#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "align/align_choice.h"
#include "asperity/base/progress.h"
#include "asperity/studio/block.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// Registers what the choice names and writes it into the project's folder `name`, byte for byte as `asperity register`
// does: from where the choice's registration began if the pose is its own, else from the pose. Gives {"name","scene",
// "trustworthy","verdict","T_mesh_world","command"}, the command being the line that writes the same. Throws Advice
// without a pose, Error as register_scans and OutputFolder do, and Cancelled: then nothing is written.
// Without a name the scans are added to the scene whose mesh the choice has, as by `asperity register --into`; Advice
// if it has none.
Json write_alignment(const AlignChoice& choice, const Project& project, const std::optional<std::string>& name,
                     Hub& hub, const Observer& observer);

}  // namespace asperity::studio
