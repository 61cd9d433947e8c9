#pragma once

#include <filesystem>
#include <string>

#include "asperity/pipeline/register_scans.h"

namespace asperity {

// registration.json: T_mesh_world as [x, y, z, qw, qx, qy, qz] (m), the residual, what ended the fit, what the
// scans do not determine, the runner-up, the coordinates' warp, problems, settings and version. nan is null. The
// same result gives the same bytes.
std::string format_registration(const ScansOnMesh& result);

// True if `folder` holds a registration.json of ours and nothing that `register` does not write. Never throws.
bool is_registration_folder(const std::filesystem::path& folder) noexcept;

}  // namespace asperity
