#pragma once

#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/scene/scene.h"
#include "setup/project_setup.h"

namespace asperity::studio {

// What the pages show of a mesh, or of the first mesh of a scene, as JSON:
//   {"objects",                                 how many meshes the file has
//    "unit_m","unit_from","unit_text",          the unit and who stated it: "file", "page" or "project"
//    "likely",                                  whether the size is one that is scanned by hand
//    "triangles","vertices","positions",        vertices of the file, and how many of them differ and are used
//    "size_m":[x,y,z],"area_m2","volume_m3",    the volume is null unless the mesh is closed and oriented
//    "parts","closed","open_edges","edges","edge_m":[shortest,median,longest],
//    "non_manifold_edges","non_manifold_vertices","flipped_edges","degenerate_triangles",
//    "texture_coordinates","normals",           whether the file has any
//    "textured_triangles",                      with haptic coordinates
//    "problems":[text]}
// Throws Cancelled.
Json mesh_info_json(const Scene& scene, const MeshReading& reading, const Observer& observer = {});

// The same of a file, or of a folder's scene.json. Throws Error, Cancelled.
Json read_mesh_info(const std::filesystem::path& file, const MeshReading& reading, const Observer& observer);

}  // namespace asperity::studio
