#pragma once

#include <string>

#include "asperity/geometry/write_gltf.h"
#include "tinygltf_config.h"

namespace asperity {

// The file of a model with one scene, one buffer and what write_gltf() sets: the JSON, keys sorted, with the buffer as
// a data URI, or GLB. tinygltf's own writer crashes where memory runs out: nlohmann's basic_json is an object without
// members when their allocation fails, and its destructor reads them. Throws Error for texts that are not UTF-8.
std::string gltf_text(const tinygltf::Model& model, GltfForm form);

}  // namespace asperity
