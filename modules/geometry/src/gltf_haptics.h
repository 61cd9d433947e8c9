#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "asperity/geometry/write_gltf.h"
#include "gltf_buffer.h"
#include "tinygltf_config.h"

namespace asperity {

inline constexpr const char* kMpegHapticMaterial = "MPEG_haptic_material";

// The haptic textures of a glTF file in the making, one an entry of GltfExport::textures.
struct GltfHaptics {
  std::map<std::int32_t, std::size_t> place;   // of a haptic texture's index in the lists below
  std::vector<int> normal_map;                 // glTF texture; -1: none
  std::vector<tinygltf::Value::Object> extra;  // what the materials say of it under extras.asperity

  int place_of(std::int32_t index) const {
    const auto found = place.find(index);
    return found == place.end() ? -1 : static_cast<int>(found->second);
  }
};

// The glTF texture that shows the image.
int add_gltf_image(tinygltf::Model& model, GltfBuffer& buffer, const GltfImage& image);

// Adds the images of the haptic textures and the file's extension MPEG_haptic_material. Throws Error as format_gltf.
GltfHaptics add_gltf_haptics(tinygltf::Model& model, GltfBuffer& buffer, const GltfExport& scene);

}  // namespace asperity
