#include "coarse_fits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace asperity::registration {
namespace {

// A point of the unit ball from three numbers of [0, 1), volume kept.
Eigen::Vector3d in_ball(double u, double v, double w) {
  const double z = 2.0 * u - 1.0;
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double angle = 2.0 * std::numbers::pi * v;
  return std::cbrt(w) * Eigen::Vector3d(across * std::cos(angle), across * std::sin(angle), z);
}

}  // namespace

std::vector<CentredPose> sample_starts_around(const CentredPose& guess, int count, double radius_m, double turn_deg) {
  // Roberts' sequence (2018): multiples of the powers of 1/g, with g the root of g^7 = g + 1.
  constexpr double kRoot = 1.1127756842787055;
  std::vector<CentredPose> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 1; i <= count; ++i) {
    std::array<double, 6> u{};
    double power = 1.0;
    for (double& value : u) {
      power /= kRoot;
      value = std::fmod(0.5 + i * power, 1.0);
    }
    Vector6 motion;
    motion << turn_deg * std::numbers::pi / 180.0 * in_ball(u[0], u[1], u[2]), radius_m * in_ball(u[3], u[4], u[5]);
    out.push_back(moved(guess, motion));
  }
  return out;
}

std::vector<CoarseRun> run_coarse_fits(Matcher& matcher, const PointSet& points, const std::vector<CentredPose>& starts,
                                       const FitOptions& options, double least_width_m, std::size_t keep,
                                       IterationWatch& watch) {
  std::vector<CoarseRun> runs;
  runs.reserve(starts.size());
  double least_scale_m = std::numeric_limits<double>::infinity();
  for (const CentredPose& start : starts) {
    watch.next_start();
    const Fit fit = fit_pose(matcher, points, start, options);
    if (!fit.enough) continue;
    CoarseRun run{fit.pose, fit.scale_m, 0.0, {}};
    run.distances_m.reserve(matcher.size());
    for (const Match& m : matcher.matches()) {
      run.distances_m.push_back(m.usable ? std::abs(m.distance_m) : std::numeric_limits<double>::infinity());
    }
    least_scale_m = std::min(least_scale_m, run.scale_m);
    runs.push_back(std::move(run));
  }
  const double width_m = std::max(options.robust_sigmas * least_scale_m, least_width_m);
  for (CoarseRun& run : runs) {
    for (const double d : run.distances_m) run.score_m2 += std::min(d * d, width_m * width_m);
    run.score_m2 /= static_cast<double>(run.distances_m.size());
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const CoarseRun& a, const CoarseRun& b) { return a.score_m2 < b.score_m2; });
  std::vector<CoarseRun> out;
  for (CoarseRun& run : runs) {
    if (out.size() == keep) break;
    const double same_m = 4.0 * std::max(run.scale_m, least_scale_m);
    const bool known = std::any_of(out.begin(), out.end(), [&](const CoarseRun& better) {
      return rms_between(points, better.pose, run.pose) < same_m;
    });
    if (!known) out.push_back(std::move(run));
  }
  return out;
}

}  // namespace asperity::registration
