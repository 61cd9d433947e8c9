#include "asperity/registration/find_registration.h"

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::bumpy_body;
using test::bumpy_path;
using test::kWorldMesh;
using test::limit_m;
using test::pose_error_m;
using test::seen_from;

TEST(FindRegistration, NeedsNoGuess) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 600);
  Random random(11);
  const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.1e-3, random), 0.0);
  const RegistrationResult got = find_registration({&path, 1}, body.surface, {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.1e-3)) << got.verdict;
}

}  // namespace
}  // namespace asperity
