#pragma once

#include "asperity/scene/scene.h"

namespace asperity {

// What was measured in scans, spread over the vertices of their triangles (material_map.h): of each triangle by the
// highest texture in its stack that came from a scan, whatever is painted over it. Empty if nothing was measured.
MaterialMap scan_materials(const SceneObject& object);

// Whether a map is that; a map made by hand is not.
bool is_of_scans(const SceneObject& object);

// Gives an object the map of its scans, or none if nothing was measured. `file` is what a new one is called.
void set_scan_materials(SceneObject& object, const std::string& file);

}  // namespace asperity
