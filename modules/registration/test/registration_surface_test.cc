#include "asperity/registration/registration_surface.h"

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;

// Files have triangles that name a vertex twice; they have no edges, and no normal of their own.
TEST(PrepareSurface, TrianglesWithARepeatedVertexAreHarmless) {
  TriangleMesh mesh = test::bumpy_mesh();
  const Body plain(mesh);
  const std::size_t whole = mesh.triangles.size();
  for (std::uint32_t v = 0; v < 50; ++v) mesh.triangles.push_back({v, v, v + 1});
  const Body body(std::move(mesh));
  for (std::size_t f = 0; f < whole; ++f) {
    EXPECT_EQ(body.surface.facets[f].border, plain.surface.facets[f].border);
    EXPECT_EQ(body.surface.facets[f].corner_normal, plain.surface.facets[f].corner_normal);
  }
  for (std::size_t f = whole; f < body.surface.facets.size(); ++f) EXPECT_EQ(body.surface.facets[f].border, 0u);
}

}  // namespace
}  // namespace asperity
