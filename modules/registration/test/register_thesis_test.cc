#include "asperity/registration/register_thesis.h"

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::bumpy_body;
using test::bumpy_path;
using test::kWorldMesh;
using test::perturbed;
using test::seen_from;

TEST(RegisterThesis, StopsWhenTheErrorNoLongerChanges) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(12);
  const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.1e-3, random), 0.0);
  const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 1e-3, 1.0, random);
  const RegistrationResult got = register_thesis({&path, 1}, body.bvh, guess, {});
  EXPECT_EQ(got.stopped_by, StopRule::kErrorChange);
  EXPECT_TRUE(got.converged);
  EXPECT_LT(got.mean_m, 0.1e-3);  // the seed's figure
  ThesisRegistrationConfig config;
  config.max_iterations = 2;
  const RegistrationResult stopped = register_thesis({&path, 1}, body.bvh, guess, config);
  EXPECT_EQ(stopped.stopped_by, StopRule::kIterationLimit);
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.iterations, 2);
}

}  // namespace
}  // namespace asperity
