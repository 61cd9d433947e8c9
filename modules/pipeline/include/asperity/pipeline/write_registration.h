#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/earlier_scene.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/scene.h"

namespace asperity {

// registration.json: T_mesh_world as [x, y, z, qw, qx, qy, qz] (m), the residual, what ended the fit, what the
// scans do not determine and the runner-up, all of the first placement; the same of each in `placements`; of each scan
// its placement, pose, covariance and verdicts; the coordinates' warp, problems, settings and version. Scans that
// `earlier` has and this call has not are listed with what was stored of them. `files` has of each scan those that were
// measured. nan is null. The same result gives the same bytes.
Json registration_json(const ScansOnMesh& result, const std::vector<ScanPlace>& places,
                       const std::vector<std::vector<std::string>>& files, const EarlierScene& earlier);

// Adds scans to a scene: their textures by their places, their coordinates over or under those that are there, and what
// was measured of compliance, stiffness and friction as a map over the mesh, unless the scene has a map of another
// kind. A scan that is there is replaced: it keeps index and order. Gives the textures of the scene that they cover.
std::vector<CoveredTexture> add_scans(Scene& scene, const ScansOnMesh& result, const std::vector<ScanPlace>& places,
                                      const std::vector<Scan>& scans, const std::string& date);

// The mesh with the scans' textures and coordinates. `mesh` is as it was read, with the haptic coordinates that it
// already has; its unit is `unit_m`.
Scene make_scene(const ScansOnMesh& result, const MeshFile& mesh, double unit_m);

// Writes registration.json, scene.json, textured.obj (augmented by `h` lines, seed §6.3), the textures and the
// material map, and what write_result writes of each recording (of a path alone its profile.csv), and each path on the
// mesh as path.csv (mesh frame): in `folder` if there is one scan on a mesh alone, else in a folder of the scan's name
// below it. What is beside `earlier` is written too, but for what was measured of scans that are replaced. `folder`
// exists and is empty. With `listing` a files.json is to follow. Throws Error for a name that is not that of a folder
// in it, or if a file cannot be written. Gives the textures that `earlier` has and that are covered now.
std::vector<CoveredTexture> write_registration(const std::filesystem::path& folder, const ScansOnMesh& result,
                                               const std::vector<Scan>& scans, EarlierScene earlier,
                                               bool listing = false);
void write_registration(const std::filesystem::path& folder, const ScansOnMesh& result, const std::vector<Scan>& scans,
                        const MeshFile& mesh, double unit_m);

// True if `folder` holds a registration.json of ours and nothing but the files that it lists and report.html;
// otherwise with the first other file. Never throws.
FolderContent is_registration_folder(const std::filesystem::path& folder) noexcept;

}  // namespace asperity
