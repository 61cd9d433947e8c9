#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/pipeline/register_scans.h"

namespace asperity {

// What is laid on what.
struct RegisterInput {
  MeshFile mesh;
  double unit_m = 1.0;  // of the mesh
  std::vector<Scan> scans;
};

// Throws Error for another number of textures than none, one for all scans or one a scan, and for names of scans that
// cannot be those of their folders. Nothing is read for it.
void check_register_input(const std::vector<std::string>& scans, const std::vector<std::string>& textures);

// Reads recordings (folders) and paths (CSV) with the mesh, and textures for the scans. Throws Error as
// check_register_input does, and for what cannot be read.
RegisterInput read_register_input(const std::vector<std::string>& scans, const std::string& mesh, double unit_m,
                                  const std::vector<std::string>& textures, const Observer& observer = {});

// register_scans, with what is doubtful about the mesh among the problems.
ScansOnMesh register_input(const RegisterInput& input, const std::optional<Pose>& guess, const RegisterConfig& config,
                           const RegistrationObserver& observer = {});

}  // namespace asperity
