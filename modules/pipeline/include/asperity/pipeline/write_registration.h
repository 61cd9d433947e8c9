#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asperity/geometry/mesh_file.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/scene/scene.h"

namespace asperity {

// registration.json: T_mesh_world as [x, y, z, qw, qx, qy, qz] (m), the residual, what ended the fit, what the
// scans do not determine, the runner-up, the coordinates' warp, problems, settings and version; `files` are the
// others in its folder. nan is null. The same result gives the same bytes.
std::string format_registration(const ScansOnMesh& result, std::span<const std::string> files);

// The mesh with the scans' textures and coordinates, what was measured of compliance, stiffness and friction as
// a map over it, and the registration. `mesh` is as it was read; its unit is `unit_m`.
Scene make_scene(const ScansOnMesh& result, const MeshFile& mesh, double unit_m);

// Writes registration.json, scene.json, textured.obj (augmented by `h` lines, seed §6.3), the textures and the
// material map, and what write_result writes of each recording (of a path alone its profile.csv), and each
// path on the mesh as path.csv (mesh frame): in `folder`
// if there is one scan, in a folder of the scan's name below it if there are several. `folder` exists and is empty.
// Throws Error for a name that is not that of a folder in it, or if a file cannot be written.
void write_registration(const std::filesystem::path& folder, const ScansOnMesh& result, const std::vector<Scan>& scans,
                        const MeshFile& mesh, double unit_m);

// True if `folder` holds a registration.json of ours and nothing but the files that it lists and report.html. Never
// throws.
bool is_registration_folder(const std::filesystem::path& folder) noexcept;

}  // namespace asperity
