#include "asperity/calibration/calibrate_tip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/base/units.h"
#include "pivot_fit.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestPoses = 60;
constexpr std::size_t kFewestTurned = 12;
// The median of the length of a normal vector with three components of deviation one.
constexpr double kMedianLength = 1.5382;
constexpr const char* kHowToSwing =
    "hold the tip in a dimple and swing the probe for half a minute, 30° to all sides, without letting the tip slip";

PivotPoses poses_of(const TrackerStream& stream, const TrackerCalibration& tracker) {
  if (stream.size() < kFewestPoses) {
    throw Error(fmt::format("{} poses are too few to find the tip: {}", stream.size(), kHowToSwing));
  }
  if (!(tracker.sigma_position_m.minCoeff() > 0.0) || !(tracker.sigma_rotation_rad.minCoeff() > 0.0)) {
    throw Error(
        "the tracker's noise (tracker.sigma_position_m, sigma_rotation_rad) must be positive to weigh poses by");
  }
  PivotPoses out;
  out.R.reserve(stream.size());
  out.p_m.reserve(stream.size());
  for (const Pose& pose : stream.T_world_marker) {
    if (!pose.translation_m.allFinite() || !pose.rotation.coeffs().allFinite()) throw Error("a pose is not finite");
    out.R.push_back(pose.rotation.toRotationMatrix());
    out.p_m.push_back(pose.translation_m);
  }
  return out;
}

// A pose each time the probe has turned: a rest gives few, however long it lasts.
std::vector<std::size_t> rotated_poses(const TrackerStream& stream, const TrackerCalibration& tracker,
                                       const CalibrateTipConfig& config) {
  const double turn_rad = std::max(config.least_turn_rad, 5.0 * tracker.sigma_rotation_rad.norm());
  std::vector<std::size_t> out{0};
  for (std::size_t i = 1; i < stream.size(); ++i) {
    const Eigen::Quaterniond& last = stream.T_world_marker[out.back()].rotation;
    if (last.angularDistance(stream.T_world_marker[i].rotation) > turn_rad) out.push_back(i);
  }
  if (out.size() < kFewestTurned) {
    throw Error(fmt::format("the probe hardly rotated in the {} poses: {}", stream.size(), kHowToSwing));
  }
  return out;
}

double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Pivot search_pivot(const PivotPoses& poses, const std::vector<std::size_t>& turned, const TrackerCalibration& tracker,
                   const CalibrateTipConfig& config) {
  // Some hundred poses judge a candidate as well as thousands do.
  constexpr std::size_t kJudges = 400;
  std::vector<std::size_t> judges;
  const std::size_t step = std::max<std::size_t>(turned.size() / kJudges, 1);
  for (std::size_t k = 0; k < turned.size(); k += step) judges.push_back(turned[k]);
  Random random(static_cast<std::uint64_t>(config.seed));
  Pivot best;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> four(4);
  std::vector<double> distances(judges.size());
  for (int trial = 0; trial < config.trials; ++trial) {
    for (std::size_t& place : four)
      place = turned[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(turned.size())))];
    const Pivot pivot = solve_pivot(poses, four);
    if (!pivot.tip_m.allFinite()) continue;
    for (std::size_t k = 0; k < judges.size(); ++k) distances[k] = pivot.miss_m(poses, judges[k]).norm();
    const double here = quantile(distances, config.least_share);
    if (here < least) {
      least = here;
      best = pivot;
    }
  }
  // The distances in units of noise are taken over the same set again, where they decide.
  std::vector<std::pair<double, std::size_t>> ranked;
  for (const std::size_t place : judges) ranked.emplace_back(pivot_distance(best, poses, place, tracker), place);
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> nearest;
  for (std::size_t k = 0; k < std::max<std::size_t>(ranked.size() * 2 / 5, 6) && k < ranked.size(); ++k) {
    nearest.push_back(ranked[k].second);
  }
  return solve_pivot(poses, nearest);
}

// The stretches within `edge` of the dimple: short ones and the borders to others left out.
std::vector<RowRun> stretches_inside(const Pivot& pivot, const PivotPoses& poses, const TrackerStream& stream,
                                     const TrackerCalibration& tracker, double edge, const CalibrateTipConfig& config) {
  const std::size_t n = poses.size();
  std::vector<bool> inside(n);
  for (std::size_t i = 0; i < n; ++i) inside[i] = pivot_distance(pivot, poses, i, tracker) <= edge;
  const auto seconds = [&](std::size_t first, std::size_t last) {
    return static_cast<double>(stream.t_ns[last] - stream.t_ns[first]) * kNanosecond_s;
  };
  // One bad frame is the tracker's; a stretch of them is the tip out of the dimple, and it leaves and comes slowly.
  std::vector<bool> kept = inside;
  for (std::size_t i = 0; i < n;) {
    if (inside[i]) {
      ++i;
      continue;
    }
    std::size_t last = i;
    while (last + 1 < n && !inside[last + 1]) ++last;
    if (last > i + 1) {
      for (std::size_t k = i; k-- > 0 && seconds(k, i) <= config.settle_s;) kept[k] = false;
      for (std::size_t k = last + 1; k < n && seconds(last, k) <= config.settle_s; ++k) kept[k] = false;
    }
    i = last + 1;
  }
  std::vector<RowRun> out;
  for (std::size_t i = 0; i < n;) {
    if (!kept[i]) {
      ++i;
      continue;
    }
    RowRun run{i, i};
    while (run.last < n && kept[run.last]) ++run.last;
    i = run.last;
    if (seconds(run.first, run.last - 1) >= config.shortest_s) out.push_back(run);
  }
  return out;
}

std::size_t rows_of(const std::vector<RowRun>& runs) {
  std::size_t out = 0;
  for (const RowRun& run : runs) out += run.last - run.first;
  return out;
}

// The spread of the rotations, refused if it leaves a direction of the tip open.
void check_swing(const PivotPoses& poses, const std::vector<RowRun>& runs, const TrackerCalibration& tracker,
                 const CalibrateTipConfig& config, TipCalibration& out) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  const auto count = static_cast<double>(rows_of(runs));
  for (const RowRun& run : runs) {
    for (std::size_t i = run.first; i < run.last; ++i) mean += poses.R[i] / count;
  }
  Eigen::Matrix3d V = Eigen::Matrix3d::Zero();
  for (const RowRun& run : runs) {
    for (std::size_t i = run.first; i < run.last; ++i) {
      const Eigen::Matrix3d d = poses.R[i] - mean;
      V += d.transpose() * d / count;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(V);
  out.spread = std::sqrt(std::max(eigen.eigenvalues()[0], 0.0));
  out.worst_direction = eigen.eigenvectors().col(0);
  Eigen::Index axis = 0;
  out.worst_direction.cwiseAbs().maxCoeff(&axis);
  if (out.worst_direction[axis] < 0.0) out.worst_direction = -out.worst_direction;
  if (out.spread >= std::max(config.least_spread, 5.0 * tracker.sigma_rotation_rad.norm())) return;
  const bool one_axis = eigen.eigenvalues()[1] > 6.0 * eigen.eigenvalues()[0];
  throw Error(fmt::format(
      "the swing does not determine the tip along the marker's direction ({:.2f}, {:.2f}, {:.2f}), nearly its {} axis: "
      "the probe {} (spread {:.3f} rad, {:.3f} is needed); {}",
      out.worst_direction.x(), out.worst_direction.y(), out.worst_direction.z(), "xyz"[axis],
      one_axis ? "was rotated about one axis only" : "was rotated too little", out.spread,
      std::max(config.least_spread, 5.0 * tracker.sigma_rotation_rad.norm()), kHowToSwing));
}

void judge_tip(TipCalibration& tip, const CalibrateTipConfig& config) {
  const double error_m = tip.stderr_m.maxCoeff();
  tip.verdict.text = fmt::format(
      "The tip stays within {:.2g} mm (RMS) of one point over {} poses, and its position on the probe is known to "
      "{:.2g} mm.",
      1e3 * tip.rms_m, tip.used, 1e3 * error_m);
  if (!(tip.noise_ratio <= config.residual_ratio)) {
    tip.verdict.add("tip_slid",
                    fmt::format("the tip misses the dimple by {:.2g} mm, {:.1f} times what the tracker's noise allows: "
                                "it slid, the marker is loose, or the stated noise of the tracker is too small",
                                1e3 * tip.rms_m, tip.noise_ratio));
  }
  if (!(error_m <= config.uncertainty_m)) {
    tip.verdict.add("tip_uncertain", fmt::format("the tip is known to {:.2g} mm only", 1e3 * error_m));
  }
  const double share = static_cast<double>(tip.used) / static_cast<double>(tip.poses);
  if (!(share >= config.least_share)) {
    tip.verdict.add("little_in_dimple",
                    fmt::format("only {:.0f} % of the poses have the tip in one dimple", 100.0 * share));
  }
}

}  // namespace

TipCalibration calibrate_tip(const TrackerStream& stream, const TrackerCalibration& tracker,
                             const CalibrateTipConfig& config) {
  const PivotPoses poses = poses_of(stream, tracker);
  const std::vector<std::size_t> turned = rotated_poses(stream, tracker, config);
  Pivot pivot = search_pivot(poses, turned, tracker, config);
  std::vector<double> distances;
  for (const std::size_t place : turned) distances.push_back(pivot_distance(pivot, poses, place, tracker));
  // The 40 % quantile of a three-component normal vector's length is 0.89 of its median.
  double ratio = quantile(distances, 0.4) / (0.89 * kMedianLength);

  TipCalibration out;
  out.poses = poses.size();
  std::vector<RowRun> runs;
  PivotFit fit;
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    const double edge = config.slip_sigmas * ratio * (round == 0 ? 1.5 : 1.0);
    const std::vector<RowRun> next = stretches_inside(pivot, poses, stream, tracker, edge, config);
    if (rows_of(next) < kFewestPoses) {
      throw Error(fmt::format("fewer than {} poses have the tip in one dimple: {}", kFewestPoses, kHowToSwing));
    }
    const bool same = next.size() == runs.size() && rows_of(next) == rows_of(runs);
    runs = next;
    check_swing(poses, runs, tracker, config, out);
    if (same) break;
    fit = fit_pivot(poses, runs, pivot, tracker);
    pivot = fit.pivot;
    std::vector<double> used;
    for (const RowRun& run : runs) {
      for (std::size_t i = run.first; i < run.last; ++i) used.push_back(pivot_distance(pivot, poses, i, tracker));
    }
    ratio = quantile(used, 0.5) / kMedianLength;
  }

  out.used = rows_of(runs);
  out.tip_in_marker_m = fit.pivot.tip_m;
  out.covariance_m2 = fit.covariance.topLeftCorner<3, 3>();
  out.stderr_m = out.covariance_m2.diagonal().cwiseSqrt();
  out.dimple_world_m = fit.pivot.dimple_m;
  out.dimple_stderr_m = fit.covariance.diagonal().tail<3>().cwiseSqrt();
  out.rms_m = fit.rms_m;
  out.expected_rms_m = fit.expected_rms_m;
  out.noise_ratio = fit.noise_ratio;
  out.independent_poses = static_cast<double>(out.used) * fit.independent_covariance.topLeftCorner<3, 3>().trace() /
                          out.covariance_m2.trace();
  for (const RowRun& run : runs) out.used_stretches.push_back({stream.t_ns[run.first], stream.t_ns[run.last - 1]});
  judge_tip(out, config);
  return out;
}

}  // namespace asperity
