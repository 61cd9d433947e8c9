#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include "asperity/geometry/mesh_bvh.h"
#include "bvh_meshes.h"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (void* const p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return p;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace asperity {
namespace {

TEST(MeshBvh, QueriesAllocateNothing) {
  const test::NamedMesh named{"soup", test::soup(1000, 0.2, 41)};
  const MeshBvh bvh(named.mesh);
  const auto points = test::query_points(named, 1000, 42);
  std::array<std::uint32_t, 16> within{};
  const long before = allocations;
  ClosestPoint nearest;
  std::size_t found = 0;
  for (const auto& p : points) {
    nearest = bvh.closest_point(p, nearest);
    found += bvh.closest_point(p, 0.1).found();
    found += bvh.cast_ray(p, Eigen::Vector3d(0.1, 0.2, 0.3) - p).found();
    found += bvh.triangles_within(p, 0.3, within);
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(found, 0u);
}

}  // namespace
}  // namespace asperity
