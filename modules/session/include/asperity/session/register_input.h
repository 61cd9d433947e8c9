#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/pipeline/earlier_scene.h"
#include "asperity/pipeline/register_scans.h"

namespace asperity {

// What is laid on what: scans on a mesh, or on that of a scene, to be added to it.
struct RegisterInput {
  EarlierScene onto;
  std::vector<Scan> scans;

  const MeshFile& mesh() const { return onto.object().mesh; }
  double unit_m() const { return onto.object().unit_m; }
};

// Throws Error for another number of textures than none, one for all scans or one a scan, and for names of scans that
// cannot be those of their folders. Nothing is read for it.
void check_register_input(const std::vector<std::string>& scans, const std::vector<std::string>& textures);

// Reads recordings (folders) and paths (CSV) with the mesh or scene.json, and textures for the scans. Without a unit it
// is that of the scene, or of a mesh 1 m. Throws Error as check_register_input does, and for what cannot be read;
// WrongUnit (scene/set_mesh_unit.h) for a scene of another unit.
RegisterInput read_register_input(const std::vector<std::string>& scans, const std::string& mesh,
                                  std::optional<double> unit_m, const std::vector<std::string>& textures,
                                  const Observer& observer = {});

// The MD5 sum of a recording's files, or of a path's: "md5:" and 32 digits. The same wherever they lie. Throws Error if
// one cannot be read.
std::string recording_checksum(const std::filesystem::path& path);

// A mesh file alone, or the mesh of a scene.json. Throws Error as read_scene does.
MeshFile read_register_mesh(const std::filesystem::path& file, const Observer& observer = {});

// Whether a mesh is that of a scene: the same vertices and triangles.
bool is_same_mesh(const MeshFile& a, const MeshFile& b);

// register_scans, with quality warnings about the mesh among the problems.
ScansOnMesh register_input(const RegisterInput& input, const std::optional<Pose>& guess, const RegisterConfig& config,
                           const RegistrationObserver& observer = {});

}  // namespace asperity
