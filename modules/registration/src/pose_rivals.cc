#include "asperity/registration/pose_rivals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "asperity/algebra/solve.h"
#include "asperity/registration/chance_of_gap.h"
#include "asperity/registration/find_symmetry.h"
#include "choose_points.h"
#include "match_points.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

constexpr double kAmbiguousOdds = 0.01;
constexpr double kNegligible = 12.0;  // logarithm of the odds beyond which nothing is asked of a rival

bool are_one(const PointSet& points, const Pose& a, const Pose& b, const RivalConfig& config) {
  return rms_between(points, centred(a, points), centred(b, points)) < config.same_m &&
         rotation_between_rad(a, b) < config.same_rad;
}

// Whether the mesh maps onto itself along a motion about the points' mean, in both senses of some millimetres.
bool is_symmetric_motion(const RegistrationSurface& surface, const PointSet& points, const Pose& pose, const Vector6& v,
                         double reach_m, double surface_error_m) {
  const CentredPose here = centred(pose, points);
  for (const double step_m : {reach_m, -reach_m}) {
    const Pose there = uncentred(moved(here, step_m * v), points);
    const auto symmetry = find_symmetry(surface, there * pose.inverse(), surface_error_m);
    if (!symmetry) return false;
    const CentredPose mapped = centred(*symmetry * pose, points);
    if (rms_between(points, mapped, centred(there, points)) > 0.25 * reach_m) return false;
  }
  return true;
}

// Of the points within four times their scale.
double residual_m(const RegistrationSurface& surface, const PointSet& points, const Pose& pose) {
  constexpr std::size_t kPoints = 500;
  constexpr double kFar = 4.0;
  Matcher matcher(surface, points, choose_uniform(points, kPoints), {});
  matcher.match(centred(pose, points));
  double square_m2 = 0.0, count = 0.0;
  for (const Match& m : matcher.matches()) {
    if (!m.usable || std::abs(m.distance_m) > kFar * matcher.scale_m()) continue;
    square_m2 += m.distance_m * m.distance_m;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(square_m2 / count) : 0.0;
}

// How likely the best of the valleys of a mesh that is not the object's stands out as this one does. A guess has no say
// in it: it knows where the object was, not what it is.
double chance_of(const RegistrationSurface& surface, const PointSet& points, const WeighedPose& at,
                 std::span<const WeighedPose> found, const RivalConfig& config) {
  constexpr double kAlike = 1.0;
  const auto same = [&](const Pose& a, const Pose& b) {
    if (are_one(points, a, b, config)) return true;
    const auto symmetry = find_symmetry(surface, b * a.inverse(), config.surface_error_m);
    return symmetry && are_one(points, *symmetry * a, b, config);
  };
  double best = -0.5 * at.fit;
  std::vector<const WeighedPose*> others;
  for (const WeighedPose& other : found) {
    const double value = -0.5 * other.fit;
    // What the mesh's own symmetry makes alike is one valley.
    if (are_one(points, at.T_mesh_world, other.T_mesh_world, config) ||
        (std::abs(value - best) < kAlike && same(at.T_mesh_world, other.T_mesh_world))) {
      best = std::max(best, value);
      continue;
    }
    const bool known = std::any_of(others.begin(), others.end(), [&](const WeighedPose* kept) {
      return std::abs(value + 0.5 * kept->fit) < kAlike && same(kept->T_mesh_world, other.T_mesh_world);
    });
    if (!known) others.push_back(&other);
  }
  std::vector<double> values;
  for (const WeighedPose* other : others) values.push_back(-0.5 * other->fit);
  return chance_of_gap(best, std::move(values));
}

void cut_sentence(std::string& text, std::string_view begin) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return;
  const std::size_t end = text.find(". ", at);
  text.erase(at, end == std::string::npos ? std::string::npos : end + 1 - at);
}

}  // namespace

PoseRivals find_rivals(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const WeighedPose& at,
                       std::span<const WeighedPose> found, bool searched, const RivalConfig& config) {
  Problems ignored;
  const PointSet points = gather_points(paths, ignored);
  PoseRivals out;
  out.judged = true;
  out.searched = searched;
  out.slow_ratio = at.slow_ratio;
  out.slow_ratio_sigma = at.slow_ratio_sigma;
  out.outlying = at.outlying;
  const Pose& pose = at.T_mesh_world;
  // The pose may be a little beside its valley's own maximum.
  double mass = at.log_mass;
  for (const WeighedPose& other : found) {
    if (are_one(points, pose, other.T_mesh_world, config)) mass = std::max(mass, other.log_mass);
  }
  for (const WeighedPose& other : found) {
    const double log_odds = other.log_mass - mass;
    if (are_one(points, pose, other.T_mesh_world, config)) continue;
    const bool likely = log_odds > -kNegligible;
    if (!likely && out.rival) break;
    const auto symmetry = find_symmetry(surface, other.T_mesh_world * pose.inverse(), config.surface_error_m);
    if (symmetry && are_one(points, *symmetry * pose, other.T_mesh_world, config)) {
      if (likely) ++out.symmetric_copies;
      continue;
    }
    out.odds += std::exp(std::min(log_odds, 700.0));
    const double higher = std::max(out.log_odds, log_odds), lower = std::min(out.log_odds, log_odds);
    out.log_odds = higher + std::log1p(std::exp(lower - higher));
    if (out.rival) continue;
    out.rival = RunnerUp{other.T_mesh_world, residual_m(surface, points, other.T_mesh_world),
                         rms_between(points, centred(pose, points), centred(other.T_mesh_world, points)),
                         rotation_between_rad(pose, other.T_mesh_world)};
  }

  out.chance = chance_of(surface, points, at, found, config);

  // The standard deviations, without the motions along which the mesh is its own image.
  const Matrix6 metric = motion_metric(points, centred(pose, points));
  const SymmetricEigen modes = symmetric_eigen(at.information, metric);
  constexpr double kSmall_m = 0.3e-3, kSmall_rad = 5e-3;
  const double most_m = 0.5 * points.radius_m;
  double square_m2 = 0.0, square_rad2 = 0.0;
  for (int k = 0; k < 6; ++k) {
    const Vector6 v = modes.vectors.col(k);
    const double sigma_m = modes.values[k] > 0.0 ? std::min(1.0 / std::sqrt(modes.values[k]), most_m) : most_m;
    const double sigma_rad = sigma_m * v.head<3>().norm();
    const bool known = sigma_m < kSmall_m && sigma_rad < kSmall_rad;
    if (!known) {
      const double reach_m = std::min({3e-3, 0.2 / std::max(v.head<3>().norm(), 1e-9), 0.1 * points.radius_m});
      if (is_symmetric_motion(surface, points, pose, v, reach_m, config.surface_error_m)) {
        out.symmetric_motion = true;
        continue;
      }
    }
    square_m2 += sigma_m * sigma_m;
    square_rad2 += sigma_rad * sigma_rad;
  }
  out.sigma_m = std::sqrt(square_m2);
  out.sigma_rad = std::sqrt(square_rad2);
  return out;
}

void state_rivals(const PoseRivals& rivals, RegistrationResult& result) {
  result.rivals = rivals;
  result.ambiguous = rivals.odds > kAmbiguousOdds;
  result.runner_up = rivals.rival;
  for (const std::string_view old :
       {" Ambiguous:", " The next best pose", " No other pose", " Other starts were not"}) {
    cut_sentence(result.verdict, old);
  }
  const char* const where = rivals.searched ? "anywhere on the mesh" : "near the guess";
  if (!rivals.rival) {
    result.verdict += fmt::format(" No other pose {} is nearly as likely.", where);
  } else {
    const std::string place =
        fmt::format("{:.2f} mm and {:.2f} degrees away ({:.4f} mm RMS)", 1e3 * rivals.rival->distance_m,
                    180.0 / std::numbers::pi * rivals.rival->rotation_rad, 1e3 * rivals.rival->rms_m);
    result.verdict +=
        result.ambiguous
            ? fmt::format(" Ambiguous: poses {}, the likeliest {}, are as likely by a factor of e^{:.1f}.", where,
                          place, rivals.log_odds)
            : fmt::format(" All other poses {}, the likeliest {}, are less likely by a factor of e^{:.1f}.", where,
                          place, -rivals.log_odds);
  }
  if (rivals.symmetric_copies > 0 || rivals.symmetric_motion) result.verdict += " The mesh maps onto itself.";
}

}  // namespace asperity
