#include <gtest/gtest.h>

#include <array>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/testkit/count_allocations.h"
#include "bvh_meshes.h"

namespace asperity {
namespace {

TEST(MeshBvh, QueriesAllocateNothing) {
  const test::NamedMesh named{"soup", test::soup(1000, 0.2, 41)};
  const MeshBvh bvh(named.mesh);
  const auto points = test::query_points(named, 1000, 42);
  std::array<std::uint32_t, 16> within{};
  const std::size_t before = testkit::count_allocations();
  ClosestPoint nearest;
  std::size_t found = 0;
  for (const auto& p : points) {
    nearest = bvh.closest_point(p, nearest);
    found += bvh.closest_point(p, 0.1).found();
    found += bvh.cast_ray(p, Eigen::Vector3d(0.1, 0.2, 0.3) - p).found();
    found += bvh.triangles_within(p, 0.3, within);
  }
  EXPECT_EQ(testkit::count_allocations(), before);
  EXPECT_GT(found, 0u);
}

}  // namespace
}  // namespace asperity
