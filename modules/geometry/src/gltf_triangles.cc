#include "gltf_triangles.h"

#include "asperity/base/error.h"
#include "tinygltf_config.h"

namespace asperity {

std::vector<Triangle> gltf_triangles(int mode, std::span<const std::uint32_t> order, const std::string& what) {
  std::vector<Triangle> out;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (order.size() % 3 != 0) throw Error(what + ": " + std::to_string(order.size()) + " corners are no triangles");
    out.reserve(order.size() / 3);
    for (std::size_t i = 0; i < order.size(); i += 3) out.push_back({order[i], order[i + 1], order[i + 2]});
  }
  for (std::size_t i = 2; mode == TINYGLTF_MODE_TRIANGLE_STRIP && i < order.size(); ++i) {
    const bool odd = i % 2 == 1;
    const Triangle t{order[i - 2], order[odd ? i : i - 1], order[odd ? i - 1 : i]};
    // Strips are joined by triangles that have a corner twice.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(t);
  }
  for (std::size_t i = 2; mode == TINYGLTF_MODE_TRIANGLE_FAN && i < order.size(); ++i) {
    out.push_back({order[0], order[i - 1], order[i]});
  }
  return out;
}

}  // namespace asperity
