#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asperity/geometry/triangle_mesh.h"

namespace bench {

// One library's closest points on one mesh.
class ClosestPeer {
 public:
  virtual ~ClosestPeer() = default;
  virtual const char* name() const = 0;
  // The distance of every point; `warm`: each search may use the answer of the one before.
  virtual void distances(std::span<const Eigen::Vector3d> points_m, bool warm, std::span<double> out_m) const = 0;
  virtual std::size_t memory_bytes() const { return 0; }  // 0: not known
};

std::unique_ptr<ClosestPeer> make_embree_peer(const asperity::TriangleMesh& mesh);
std::unique_ptr<ClosestPeer> make_cgal_peer(const asperity::TriangleMesh& mesh);

}  // namespace bench
