#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// The name under which the binary chunk of a .glb is handed to tinygltf as a buffer.
inline constexpr const char* kBinaryChunk = "binary-chunk";

// A glTF file checked before tinygltf sees it: nesting and sizes bounded, what a mesh does not need removed.
struct GltfDocument {
  std::string json;
  std::string_view binary;               // the chunk that buffer 0 names, cut to the buffer's length
  std::vector<std::string> image_files;  // one an image; empty: not a file
  Problems problems;
};

GltfDocument check_gltf(std::string_view bytes, const std::string& name, const MeshLimits& limits,
                        const Observer& observer);

}  // namespace asperity
