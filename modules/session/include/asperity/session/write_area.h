#pragma once

#include <filesystem>
#include <string>

#include "asperity/pipeline/make_area.h"
#include "asperity/session/area_input.h"

namespace asperity {

// Writes an area into `folder`, which exists and is empty: the scene of `input` with the area's texture, if there is
// one, area.json, the texture's height, normal and σ map as pictures, and files.json. Gives what area.json says. Throws
// Error if a file cannot be written.
std::string write_area(const std::filesystem::path& folder, const AreaInput& input, const AreaResult& area);

}  // namespace asperity
