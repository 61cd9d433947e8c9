#include "register_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "asperity/base/text.h"

namespace asperity::app {

namespace {

std::string pose_text(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                     q.z());
}

std::string pose_lines(const RegistrationResult& registration) {
  std::string out = fmt::format(
      "registration  {} points, {} outliers, residual {:.3f} mm RMS, {} after {} iterations ({})\n"
      "T_mesh_world  {}\n",
      registration.points, registration.outliers, registration.rms_m * 1e3,
      registration.converged ? "converged" : "not converged", registration.iterations,
      kStopRuleNames.at(static_cast<std::size_t>(registration.stopped_by)), pose_text(registration.T_mesh_world));
  for (const UndeterminedMotion& motion : registration.undetermined) {
    out += "undetermined  " + motion.description + "\n";
  }
  if (registration.runner_up) {
    const RunnerUp& other = *registration.runner_up;
    out += fmt::format("runner-up     residual {:.3f} mm RMS, {:.1f} mm and {:.1f} degrees away\n", other.rms_m * 1e3,
                       other.distance_m * 1e3, other.rotation_rad * 180.0 / std::numbers::pi);
  }
  if (!registration.verdict.empty()) out += "verdict       " + registration.verdict + "\n";
  return out;
}

}  // namespace

std::string register_summary(const ScansOnMesh& result) {
  std::string out;
  for (std::size_t k = 0; k < result.placements.size(); ++k) {
    if (result.placements.size() > 1) {
      const std::size_t count = result.placements[k].scans.size();
      out += fmt::format("placement {}   {} {}\n", k + 1, count, count == 1 ? "scan" : "scans");
    }
    out += pose_lines(result.placements[k].registration);
  }
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const RegisteredScan& scan = result.scans[i];
    const double length_mm = scan.path.s_m.empty() ? 0.0 : (scan.path.s_m.back() - scan.path.s_m.front()) * 1e3;
    out += fmt::format("{}\n  path        {:.2f} mm on the mesh, {} triangles", printable(scan.name, 200), length_mm,
                       i < result.coordinates.warps.size() ? result.coordinates.warps[i].triangles : 0);
    if (scan.path_texture) {
      out += fmt::format(", texture {} harmonics, {:.1f} µm RMS, model error {:.1f} µm",
                         scan.path_texture->series.fit.texture.a_m.size(),
                         scan.path_texture->series.fit.rms_height_m * 1e6,
                         scan.path_texture->series.fit.rms_error_m * 1e6);
    }
    out += "\n";
    if (result.placements.size() > 1) {
      out += fmt::format("  placement   {}, T_mesh_world {}\n", scan.placement + 1,
                         pose_text(result.registration_of(scan).T_mesh_world));
    }
    if (scan.process.accuracy && scan.process.accuracy->profile) {
      const ProfileComparison& truth = *scan.process.accuracy->profile;
      out += !std::isfinite(truth.correlation)
                 ? "  truth       nothing to compare\n"
                 : fmt::format("  truth       correlation {:.3f}, gain {:.3f}, {:.1f} µm RMS, length {:+.2f} %\n",
                               truth.correlation, truth.gain, truth.rms_um, truth.length_error_percent);
    }
    for (const Problem& problem : scan.process.problems) out += "  note        " + problem.message + "\n";
  }
  for (const Problem& problem : result.problems) out += "note          " + problem.message + "\n";
  return out;
}

}  // namespace asperity::app
