#include "registration_verdict.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace asperity::registration {
namespace {

// With fewer inliers the path does not lie on this mesh.
constexpr double kLeastInliers = 0.5;

std::string_view stop_words(StopRule rule) {
  switch (rule) {
    case StopRule::kErrorChange:
      return "the error no longer changes";
    case StopRule::kPoseChange:
      return "steps are small against the pose's standard deviation";
    case StopRule::kStalled:
      return "the cost no longer falls";
    case StopRule::kIterationLimit:
      break;
  }
  return "iteration limit";
}

}  // namespace

void write_registration_verdict(const RegistrationFindings& findings, const PointSet& points, std::size_t used,
                                const RegistrationConfig& config, RegistrationResult& out) {
  const ConvergedPose& best = findings.best;
  out.T_mesh_world = uncentred(best.pose, points);
  out.centre_mesh_m = best.pose.centre_m;
  out.rms_m = best.rms_m;
  out.mean_m = best.mean_m;
  out.points = used;
  out.outliers = best.outliers;
  out.stopped_by = best.fit.stopped_by;
  out.converged = best.fit.enough && out.stopped_by != StopRule::kIterationLimit;
  out.covariance = best.observability.covariance;
  for (const Vector6& motion : best.observability.unobservable) {
    out.undetermined.push_back(
        describe_motion(motion, best.pose.centre_m, best.observability.unobservable_sigma_m, points.radius_m));
  }

  const double inliers = 1.0 - static_cast<double>(out.outliers) / static_cast<double>(used);
  const bool on_mesh = best.fit.enough && inliers >= kLeastInliers;
  const bool ambiguous = out.runner_up && findings.runner_up_fits;
  out.ambiguous = ambiguous;
  out.trustworthy = out.converged && on_mesh && !ambiguous;

  out.verdict = fmt::format("{}: {} ({} iterations). Residual {:.4f} mm RMS over {} of {} points",
                            out.converged ? "converged" : "not converged",
                            best.fit.enough ? stop_words(out.stopped_by) : "too few points meet the mesh",
                            out.iterations, 1e3 * out.rms_m, used - out.outliers, used);
  out.verdict += fmt::format("; the path's own noise is about {:.4f} mm.", 1e3 * findings.noise_m);
  if (!on_mesh) {
    out.verdict += fmt::format(" Only {:.0f} % of the points are on the mesh.", 100.0 * inliers);
  }
  if (out.undetermined.empty()) {
    out.verdict +=
        fmt::format(" Every motion is determined, to {:.4f} mm RMS.", 1e3 * best.observability.determined_rms_m);
  } else {
    out.verdict += " Not determined: ";
    for (std::size_t i = 0; i < out.undetermined.size(); ++i) {
      out.verdict += (i == 0 ? "" : "; ") + out.undetermined[i].description;
    }
    out.verdict += ".";
  }
  if (ambiguous) {
    out.verdict += fmt::format(
        " Ambiguous: {:.2f} mm and {:.2f} degrees away it fits as well ({:.4f} mm RMS); the path does not determine "
        "which is correct.",
        1e3 * out.runner_up->distance_m, 180.0 / std::numbers::pi * out.runner_up->rotation_rad,
        1e3 * out.runner_up->rms_m);
  } else if (out.runner_up) {
    out.verdict +=
        fmt::format(" The next best pose is {:.2f} mm and {:.2f} degrees away and fits worse ({:.4f} mm RMS).",
                    1e3 * out.runner_up->distance_m, 180.0 / std::numbers::pi * out.runner_up->rotation_rad,
                    1e3 * out.runner_up->rms_m);
  } else if (findings.tried == TriedStarts::kAboutGuess) {
    out.verdict += fmt::format(" No other pose within {:.0f} mm and {:.0f} degrees of the guess.",
                               1e3 * config.starts.radius_m, config.starts.turn_deg);
  } else {
    out.verdict += findings.tried == TriedStarts::kNone ? " Other starts were not tried." : " No other pose was found.";
  }
}

}  // namespace asperity::registration
