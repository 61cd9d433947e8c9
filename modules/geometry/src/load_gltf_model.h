#pragma once

#include <filesystem>
#include <string>

#include "asperity/geometry/mesh_limits.h"
#include "gltf_document.h"
#include "tinygltf_config.h"

namespace asperity {

// tinygltf's model of a document, with the buffers that it names read from `folder` or below (none where that is empty)
// and not more than limits.file_bytes of them. Images stay undecoded. Throws Error naming `name`.
tinygltf::Model load_gltf_model(const GltfDocument& document, const std::string& name,
                                const std::filesystem::path& folder, const MeshLimits& limits);

}  // namespace asperity
