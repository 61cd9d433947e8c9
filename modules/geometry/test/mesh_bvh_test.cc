#include "asperity/geometry/mesh_bvh.h"

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "brute_force.h"

namespace asperity {
namespace {

Eigen::Vector3d random_point(Random& random, double half_width) {
  return {random.uniform(-half_width, half_width), random.uniform(-half_width, half_width),
          random.uniform(-half_width, half_width)};
}

TEST(MeshBvh, NearestDistanceIsThatOfBruteForceOnRandomTriangles) {
  Random random(1);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Eigen::Vector3d centre = random_point(random, 1.0);
    for (int k = 0; k < 3; ++k) mesh.vertices_m.push_back(centre + random_point(random, 0.2));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const MeshBvh bvh(mesh);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = random_point(random, 1.5);
    const ClosestPoint nearest = bvh.closest_point(p);
    ASSERT_TRUE(nearest.found());
    EXPECT_NEAR(nearest.distance_m, static_cast<double>(test::mesh_distance(mesh, p)), 1e-15);
    EXPECT_NEAR((nearest.p_m - p).norm(), nearest.distance_m, 1e-15);
  }
}

}  // namespace
}  // namespace asperity
