#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// The triangles of each haptic texture (−1: none) with each material of the mesh (−1: none), in rising order.
inline std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint32_t>> mesh_groups(const MeshFile& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint32_t>> out;
  auto part = mesh.parts.begin();
  std::int32_t material = -1;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (; part != mesh.parts.end() && part->first_triangle <= i; ++part) material = part->material;
    out[{mesh.haptic.empty() ? -1 : mesh.haptic[i].texture, material}].push_back(i);
  }
  return out;
}

}  // namespace asperity
