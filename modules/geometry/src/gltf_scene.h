#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "tinygltf_config.h"

namespace asperity {

// T_parent_node. Throws Error naming `place` for a matrix that is not affine, a rotation of length zero, or numbers
// that are not finite.
Eigen::Affine3d gltf_transform(const tinygltf::Node& node, const std::string& place);

// The nodes that have no parent: those of the default scene, or, where the file has no scenes, all of them. Throws
// Error naming `name` for a scene that does not exist.
std::vector<int> gltf_roots(const tinygltf::Model& model, const std::string& name);

}  // namespace asperity
