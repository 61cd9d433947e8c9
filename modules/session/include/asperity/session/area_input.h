#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A scan that is not part of an area, and why.
struct LeftOutScan {
  std::string name, reason;
};

// What `register` wrote, as an area needs it.
struct AreaInput {
  Scene scene;
  std::vector<AreaScan> scans;        // those that have a path on the mesh and a profile
  std::vector<LeftOutScan> left_out;  // of the others
  bool registered = true;             // the registration of these scans is not invalid
};

// Reads registration.json, scene.json and each scan's path.csv and profile.csv from a folder that `register` wrote.
// Left out are the scans that `leave_out` names, and those that are invalid by themselves in a placement that is not: a
// long stroke over smooth ground that holds the pose of the rest has no texture, and need not have one. Throws Error
// naming the file, line and value for what is not of that form, a triangle that the mesh does not have, a folder none
// of whose scans has a path and a profile and is not left out, a name in `leave_out` that no scan has, and two scans
// that are one measurement (check_independent).
AreaInput read_area_input(const std::filesystem::path& folder, const Observer& observer = {},
                          const std::vector<std::string>& leave_out = {});

// Adds an area's texture to the first object of `scene`: a free index, a file of its own, its triangles' coordinates
// over those that they had, which stay below (lay_texture.h). Returns the texture's place in the scene. Throws Error
// where no index or order is free.
const SceneTexture& add_area(Scene& scene, const AreaResult& area);

}  // namespace asperity
