#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// The point of a mesh that is nearest to another.
struct ClosestPoint {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();          // on the triangle, mesh frame
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();  // of p_m; sums to 1, each within 0 and 1
  double distance_m = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNone;  // index in TriangleMesh::triangles

  bool found() const { return triangle != kNone; }
};

// Where a ray meets a mesh first.
struct RayHit {
  static constexpr std::uint32_t kNone = ClosestPoint::kNone;

  double t = std::numeric_limits<double>::infinity();  // p = origin + t direction
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  std::uint32_t triangle = kNone;

  bool found() const { return triangle != kNone; }
};

// Closest-point and ray queries on a triangle mesh.
class MeshBvh {
 public:
  // Keeps what it needs of `mesh`, about 70 bytes a triangle. Throws Error for a mesh without triangles, an index out
  // of range or a vertex that is not finite; Cancelled.
  explicit MeshBvh(const TriangleMesh& mesh, const Observer& observer = {});
  ~MeshBvh();
  MeshBvh(MeshBvh&&) noexcept;
  MeshBvh& operator=(MeshBvh&&) noexcept;

  // The nearest point within `radius_m`, exact to rounding in double; of equally near triangles the one
  // with the smallest index. Not found if p is not finite or nothing is within the radius.
  // Thread-safe: yes. Realtime-safe: yes.
  ClosestPoint closest_point(const Eigen::Vector3d& p_m,
                             double radius_m = std::numeric_limits<double>::infinity()) const noexcept;

  // The same answer, faster where `previous`, the answer for a point near p, is near the new one.
  ClosestPoint closest_point(const Eigen::Vector3d& p_m, const ClosestPoint& previous) const noexcept;

  // The first hit with 0 <= t <= t_max, from either side; the direction need not be a unit vector. A ray
  // through an edge or a corner does not slip between triangles.
  // Thread-safe: yes. Realtime-safe: yes.
  RayHit cast_ray(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                  double t_max = std::numeric_limits<double>::infinity()) const noexcept;

  // The triangles that have a point within `radius_m` of p: their indices to `out`, as many as it holds, in
  // the order of the tree (the same for the same mesh). Returns how many there are, which may be more.
  // Thread-safe: yes. Realtime-safe: yes.
  std::size_t triangles_within(const Eigen::Vector3d& p_m, double radius_m,
                               std::span<std::uint32_t> out) const noexcept;

  // All that is kept, the vertices included.
  std::size_t memory_bytes() const noexcept;

 private:
  friend struct MeshBvhAccess;
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace asperity
