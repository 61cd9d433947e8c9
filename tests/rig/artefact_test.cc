#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "asperity/geometry/write_stl.h"
#include "asperity/rig/sine_grating.h"

namespace asperity {
namespace {

TEST(Artefact, TheFileInTheDocumentationIsWhatIsMade) {
  const TriangleMesh grating = make_sine_grating({});
  MeshFile file;
  for (const Eigen::Vector3d& p_m : grating.vertices_m) file.vertices.push_back(1e3 * p_m);
  file.triangles = grating.triangles;
  std::ifstream stream(ARTEFACT, std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(kept == format_stl(file));
  EXPECT_LT(kept.size(), 1'000'000U);
}

}  // namespace
}  // namespace asperity
