#include "gltf_scene.h"

#include <algorithm>

#include "asperity/base/error.h"

namespace asperity {

Eigen::Affine3d gltf_transform(const tinygltf::Node& node, const std::string& place) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    if (transform.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) throw Error(place + ": its matrix is not affine");
  } else {
    if (node.translation.size() == 3) transform.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    if (node.rotation.size() == 4) {
      Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      if (!(q.norm() > 0.0)) throw Error(place + ": its rotation is zero");
      transform.rotate(q.normalized());
    }
    if (node.scale.size() == 3) transform.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
  }
  if (!transform.matrix().allFinite()) throw Error(place + ": its transform is not finite");
  return transform;
}

std::vector<int> gltf_roots(const tinygltf::Model& model, const std::string& name) {
  if (!model.scenes.empty()) {
    const int scene = std::max(model.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model.scenes.size())
      throw Error(name + ": scene " + std::to_string(scene) + " does not exist");
    return model.scenes[static_cast<std::size_t>(scene)].nodes;
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

std::vector<Triangle> gltf_triangles(int mode, std::span<const std::uint32_t> order, const std::string& what) {
  std::vector<Triangle> out;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (order.size() % 3 != 0)
      throw Error(what + ": " + std::to_string(order.size()) + " corners are not triangles, which have three each");
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
