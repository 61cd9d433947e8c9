#include "asperity/geometry/mesh_bvh.h"

#include <cmath>

#include "mesh_bvh_tree.h"

namespace asperity {

namespace {

// From here on, in mesh units, every point of the mesh is equally far from p to the last bit, and squares might
// overflow.
constexpr double kBeyond = 0x1p100;

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

struct Corners {
  const double* at[3];
  std::uint32_t corner[3];  // of the mesh's triangle
};

Corners corners_of(const bvh::TreeData& data, std::uint32_t slot) {
  const bvh::Face face = data.faces[slot];
  const double* const v = data.vertices.data();
  return {{v + 3 * std::size_t{face.vertex0}, v + 3 * std::size_t{face.vertex1}, v + 3 * std::size_t{face.vertex2}},
          {face.corner0, face.corner1, face.corner2}};
}

bool is_beyond(const bvh::TreeData& data, const Eigen::Vector3d& p) {
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(p[k] - data.centre[k]) < kBeyond)) return true;
  return false;
}

std::uint32_t slot_of_first(const bvh::TreeData& data) {
  std::uint32_t slot = 0;
  while (data.faces[slot].triangle != 0) ++slot;
  return slot;
}

ClosestPoint from_beyond(const bvh::TreeData& data, const Eigen::Vector3d& p_m, double radius_m) {
  const Corners corners = corners_of(data, slot_of_first(data));
  ClosestPoint out;
  out.p_m = data.to_metres * Eigen::Map<const Eigen::Vector3d>(corners.at[0]);
  out.distance_m = (p_m - out.p_m).stableNorm();
  if (!(out.distance_m <= radius_m)) return {};
  out.barycentric[static_cast<int>(corners.corner[0])] = 1.0;
  out.triangle = 0;
  return out;
}

ClosestPoint closest(const bvh::TreeData& data, const bvh::TreeView& view, const bvh::Kernels& kernels,
                     const Eigen::Vector3d& p_m, double radius_m, std::uint32_t guess) {
  if (!p_m.allFinite() || !(radius_m >= 0.0)) return {};
  const Eigen::Vector3d p = data.to_mesh_units * p_m;
  if (is_beyond(data, p)) return from_beyond(data, p_m, radius_m);

  bvh::Nearest nearest;
  kernels.closest(view, p.data(), data.to_mesh_units * radius_m, guess, nearest);
  ClosestPoint out;
  const double distance_m = data.to_metres * std::sqrt(nearest.distance2);
  if (nearest.slot == bvh::kNone || !(distance_m <= radius_m)) return out;
  out.distance_m = distance_m;
  out.triangle = data.faces[nearest.slot].triangle;
  const Corners corners = corners_of(data, nearest.slot);
  int heaviest = 0;
  for (int k = 0; k < 3; ++k) {
    out.barycentric[static_cast<int>(corners.corner[k])] = nearest.weight[k];
    if (nearest.weight[k] > nearest.weight[heaviest]) heaviest = k;
  }
  // From the nearest corner, so that a corner comes out exactly.
  const auto corner = [&](int k) { return Eigen::Map<const Eigen::Vector3d>(corners.at[k]); };
  Eigen::Vector3d q = corner(heaviest);
  for (int k = 0; k < 3; ++k)
    if (k != heaviest) q += nearest.weight[k] * (corner(k) - corner(heaviest));
  out.p_m = data.to_metres * q;
  return out;
}

}  // namespace

std::vector<const bvh::Kernels*> supported_kernels() {
  std::vector<const bvh::Kernels*> out{&bvh::sse2_kernels()};
  if (has_avx2()) out.push_back(&bvh::avx2_kernels());
  return out;
}

MeshBvh::MeshBvh(const TriangleMesh& mesh, const Observer& observer) : tree_(std::make_unique<Tree>()) {
  tree_->data = bvh::build_tree(mesh, observer);
  const bvh::TreeData& data = tree_->data;
  tree_->view = {data.nodes.data(),   reinterpret_cast<const unsigned char*>(data.pool.data()),
                 data.faces.data(),   data.vertices.data(),
                 data.leaf_of.data(), {data.centre[0], data.centre[1], data.centre[2]},
                 data.root,           static_cast<std::uint32_t>(data.faces.size())};
  tree_->kernels = supported_kernels().back();
}

MeshBvh::~MeshBvh() = default;
MeshBvh::MeshBvh(MeshBvh&&) noexcept = default;
MeshBvh& MeshBvh::operator=(MeshBvh&&) noexcept = default;

ClosestPoint MeshBvh::closest_point(const Eigen::Vector3d& p_m, double radius_m) const noexcept {
  return closest(tree_->data, tree_->view, *tree_->kernels, p_m, radius_m, bvh::kNone);
}

ClosestPoint MeshBvh::closest_point(const Eigen::Vector3d& p_m, const ClosestPoint& previous) const noexcept {
  // Only the triangle is taken from `previous`: it lies on this mesh, whatever else the answer says.
  const auto& leaf_of = tree_->data.leaf_of;
  const std::uint32_t guess = previous.triangle < leaf_of.size() ? leaf_of[previous.triangle] : bvh::kNone;
  return closest(tree_->data, tree_->view, *tree_->kernels, p_m, std::numeric_limits<double>::infinity(), guess);
}

std::size_t MeshBvh::triangles_within(const Eigen::Vector3d& p_m, double radius_m,
                                      std::span<std::uint32_t> out) const noexcept {
  const bvh::TreeData& data = tree_->data;
  if (!p_m.allFinite() || !(radius_m >= 0.0)) return 0;
  const Eigen::Vector3d p = data.to_mesh_units * p_m;
  if (!is_beyond(data, p))
    return tree_->kernels->within(tree_->view, p.data(), data.to_mesh_units * radius_m, out.data(), out.size());
  if (!from_beyond(data, p_m, radius_m).found()) return 0;
  for (std::size_t i = 0; i < out.size() && i < data.leaf_of.size(); ++i) out[i] = static_cast<std::uint32_t>(i);
  return data.leaf_of.size();
}

RayHit MeshBvh::cast_ray(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                         double t_max) const noexcept {
  const bvh::TreeData& data = tree_->data;
  if (!origin_m.allFinite() || !direction.allFinite() || !(t_max >= 0.0)) return {};
  const double longest = direction.cwiseAbs().maxCoeff();
  const Eigen::Vector3d origin = data.to_mesh_units * origin_m;
  if (longest == 0.0 || is_beyond(data, origin)) return {};

  // One step of t is 2^exponent metres along a direction whose largest component is in [1, 2).
  const int exponent = std::ilogb(longest);
  Eigen::Vector3d d;
  for (int k = 0; k < 3; ++k) d[k] = std::scalbn(direction[k], -exponent);
  bvh::Hit hit;
  tree_->kernels->cast_ray(tree_->view, origin.data(), d.data(), std::scalbn(t_max, exponent) * data.to_mesh_units,
                           hit);
  if (hit.slot == bvh::kNone) return {};
  RayHit out;
  out.t = std::scalbn(hit.t * data.to_metres, -exponent);
  out.triangle = data.faces[hit.slot].triangle;
  const Corners corners = corners_of(data, hit.slot);
  for (int k = 0; k < 3; ++k) out.barycentric[static_cast<int>(corners.corner[k])] = hit.weight[k];
  return out;
}

std::size_t MeshBvh::memory_bytes() const noexcept {
  const bvh::TreeData& data = tree_->data;
  return sizeof(Tree) + data.nodes.capacity() * sizeof(bvh::Node) + data.pool.capacity() * sizeof(bvh::PoolUnit) +
         data.faces.capacity() * sizeof(bvh::Face) + data.vertices.capacity() * sizeof(double) +
         data.leaf_of.capacity() * sizeof(std::uint32_t);
}

}  // namespace asperity
