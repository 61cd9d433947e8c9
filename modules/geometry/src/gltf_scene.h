#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/geometry/triangle_mesh.h"
#include "tinygltf_config.h"

namespace asperity {

// T_parent_node. Throws Error naming `place` for a matrix that is not affine, a rotation of length zero, or numbers
// that are not finite.
Eigen::Affine3d gltf_transform(const tinygltf::Node& node, const std::string& place);

// The nodes that have no parent: those of the default scene, or, where the file has no scenes, all of them. Throws
// Error naming `name` for a scene that does not exist.
std::vector<int> gltf_roots(const tinygltf::Model& model, const std::string& name);

// The triangles of a primitive of glTF whose vertices follow each other in `order`: lists, strips and fans. Throws
// Error naming `what` for a list whose length is no multiple of three.
std::vector<Triangle> gltf_triangles(int mode, std::span<const std::uint32_t> order, const std::string& what);

}  // namespace asperity
