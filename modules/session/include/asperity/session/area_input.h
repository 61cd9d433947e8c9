#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/scene/scene.h"

namespace asperity {

// What `register` wrote, as an area needs it.
struct AreaInput {
  Scene scene;
  std::vector<AreaScan> scans;  // those that have a path on the mesh and a profile
  bool registered = true;       // the registration is not invalid
};

// Reads registration.json, scene.json and each scan's path.csv and profile.csv from a folder that `register` wrote.
// Throws Error naming the file, line and value for what is not of that form, a triangle that the mesh does not have,
// a folder none of whose scans has a path and a profile, and two scans that are one measurement (check_independent).
AreaInput read_area_input(const std::filesystem::path& folder, const Observer& observer = {});

// Adds an area's texture to the first object of `scene`: a free index, a file of its own, its triangles' coordinates
// over those that they had, which stay below (lay_texture.h). Returns the texture's place in the scene. Throws Error
// where no index or order is free.
const SceneTexture& add_area(Scene& scene, const AreaResult& area);

}  // namespace asperity
