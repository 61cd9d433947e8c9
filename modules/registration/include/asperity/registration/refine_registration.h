#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

struct RefineConfig {
  bool enabled = true;
  double memory_m = 1.5e-3;
  double slow_length_m = 20e-3;
  double slow_factor = 1.0;
  double knot_m = 5e-3;
  double outlier_sigmas = 5.0;
  double guess_sigma_m = 10e-3;
  double guess_sigma_deg = 10.0;
  int other_starts = 30;
  double other_shift_m = 6e-3;
  double other_turn_deg = 10.0;
  double undetermined_deg = 0.5;
  double overlap_m = 0.3e-3;
  int max_iterations = 40;

  template <class V>
  void visit(V& v) {
    v.field("enabled", enabled, "the pose is refined by the known errors along the path");
    v.field("memory_m", memory_m, "length of path over which the relief is correlated with itself", {1e-6, 1.0});
    v.field("slow_length_m", slow_length_m, "length of path over which the tracker's drift lasts", {1e-6, 10.0});
    v.field("slow_factor", slow_factor, "of the drift's standard deviation over the trajectory's own", {0.0, 100.0});
    v.field("knot_m", knot_m, "distance of the points between which the drift is interpolated", {1e-6, 1.0});
    v.field("outlier_sigmas", outlier_sigmas, "heights beyond this many standard deviations do not count", {2.0, 1e6});
    v.field("guess_sigma_m", guess_sigma_m, "how well the guess is known, without one the start, m", {1e-9, 1e6});
    v.field("guess_sigma_deg", guess_sigma_deg, "how well its rotation is known, degrees", {1e-6, 1e6});
    v.field("other_starts", other_starts, "guesses about the given one from which fits are tried", {0, 10000});
    v.field("other_shift_m", other_shift_m, "largest shift of these, m", {0.0, 10.0});
    v.field("other_turn_deg", other_turn_deg, "largest rotation of these, degrees", {0.0, 180.0});
    v.field("undetermined_deg", undetermined_deg, "standard deviation from which a rotation is listed as undetermined",
            {1e-3, 360.0});
    v.field("overlap_m", overlap_m,
            "strokes nearer than this, across, meet the same texture, m; 0: overlaps do not count", {0.0, 1.0});
    v.field("max_iterations", max_iterations, "limit", {1, 10000});
  }
};

struct RefinedRegistration {
  RegistrationResult registration;
  std::vector<std::vector<Eigen::Vector3d>> slow_error_world_m;  // [path][point]; empty paths if none was estimated
};

// A registered pose, refined with the paths' drift (generalised least squares; docs/registration.md). What
// keeps a scan from its mesh is not white noise: the tracker's error e lasts for centimetres, the relief has its
// own spectrum. Plain least squares follow the drift, and their covariance is far too small. Here the height
// over the facet is
//   d_i = n·(T (p_i + R_i δ − e_i)) − facet = m + relief,
// δ is what the tip's calibrated position is off by (marker axes, a priori tip_sigma_m, R_i the probe's orientation),
// e is linear between knots with the prior covariance C exp(−|Δs|/slow_length_m), and the relief is whitened
// about its mean m (known to the relief's own RMS height: a board's holes lie under its face)
// along the path, of each path by its own filter, by an autoregressive filter w_i = d_i + Σ a_k d_{i−k} (Cochrane and
// Orcutt 1949) from its own autocovariance (Yule–Walker). Gauss–Newton over pose and knots with ∇d = the facet's
// normal; the filter is made anew from round to round. So the fine signature of the mesh, its curvature over
// centimetres and less, counts as much as it is worth, and tells where along and across the mesh the tip was.
//
// `paths` are those that gave `start`, evenly spaced (to a factor of two); steps of more than three times the
// median part them. The pose has `guess`, if one was given, as a prior of guess_sigma_m and guess_sigma_deg, otherwise
// `start`. Of paths longer than 500 knots the knots lie farther apart, with a Problem. `others` are further
// poses to begin from: a path has several valleys near a guess (Fig. 25), and with the same whitening for all, the cost
// says which is the deepest. Motions that `start` lists as undetermined stay as they are. The result has the refined
// pose, residual and covariance, and lists turns that are less certain than undetermined_deg as undetermined. Where
// fewer than 30 points are usable, `start` is given back with a Problem. Throws Cancelled.
RefinedRegistration refine_registration(std::span<const MeasuredPath> paths, const MeshSurface& surface,
                                        const RegistrationResult& start, const std::optional<Pose>& guess,
                                        std::span<const Pose> others, const RefineConfig& config,
                                        const RegistrationObserver& observer = {});

}  // namespace asperity
