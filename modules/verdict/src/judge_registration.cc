#include "asperity/verdict/judge_registration.h"

#include <numbers>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kLeastInliers = 0.5;  // with fewer the path is not on this mesh

}  // namespace

Verdicts judge_registration(const PoseEvidence& evidence) {
  Verdicts out;
  if (!evidence.converged) {
    out.push_back(
        make_verdict("pose_not_converged", fmt::format("the registration did not converge in {} iteration{}",
                                                       evidence.iterations, evidence.iterations == 1 ? "" : "s")));
  }
  const auto points = static_cast<double>(evidence.points);
  const double outlying = evidence.points > 0 ? static_cast<double>(evidence.outliers) / points : 0.0;
  if (outlying > 1.0 - kLeastInliers) {
    out.push_back(
        make_verdict("off_mesh", fmt::format("only {:.0f} % of the points are on the mesh", 100.0 * (1.0 - outlying))));
  }
  if (evidence.ambiguous) {
    out.push_back(make_verdict(
        "pose_ambiguous",
        fmt::format("another pose, {:.1f} mm and {:.1f} degrees away, fits as well", 1e3 * evidence.rival_distance_m,
                    180.0 / std::numbers::pi * evidence.rival_rotation_rad)));
  }
  return out;
}

}  // namespace asperity
