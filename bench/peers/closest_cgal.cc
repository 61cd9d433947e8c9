// CGAL's tree of boxes with its search tree of hints for closest points.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

#include "closest_peer.h"

namespace bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

class CgalPeer final : public ClosestPeer {
 public:
  explicit CgalPeer(const asperity::TriangleMesh& mesh) {
    for (const auto& t : mesh.triangles) {
      const auto point = [&](std::uint32_t i) {
        const auto& v = mesh.vertices_m[i];
        return Kernel::Point_3(v.x(), v.y(), v.z());
      };
      triangles_.emplace_back(point(t[0]), point(t[1]), point(t[2]));
    }
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    tree_.accelerate_distance_queries();
  }

  const char* name() const override { return "CGAL"; }

  void distances(std::span<const Eigen::Vector3d> points_m, bool warm, std::span<double> out_m) const override {
    Tree::Point_and_primitive_id hint;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Kernel::Point_3 p(points_m[i].x(), points_m[i].y(), points_m[i].z());
      hint = warm && i > 0 ? tree_.closest_point_and_primitive(p, hint) : tree_.closest_point_and_primitive(p);
      out_m[i] = std::sqrt(CGAL::squared_distance(p, hint.first));
    }
  }

 private:
  Triangles triangles_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<ClosestPeer> make_cgal_peer(const asperity::TriangleMesh& mesh) {
  return std::make_unique<CgalPeer>(mesh);
}

}  // namespace bench
