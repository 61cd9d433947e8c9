#include "latency_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SVD>

namespace asperity {

namespace {

// Vectors that should be equal up to rotation, scale and mean.
struct Pairs {
  std::vector<Eigen::Vector3d> seen, felt;
};

struct Match {
  double cost = 1.0;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double scale = 1.0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  double motion = 0.0;
};

Match match_pairs(const Pairs& pairs, bool solve_rotation, bool solve_scale) {
  const auto n = static_cast<double>(pairs.seen.size());
  Eigen::Vector3d seen_mean = Eigen::Vector3d::Zero(), felt_mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < pairs.seen.size(); ++i) {
    seen_mean += pairs.seen[i] / n;
    felt_mean += pairs.felt[i] / n;
  }
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
  double seen2 = 0.0, felt2 = 0.0;
  for (std::size_t i = 0; i < pairs.seen.size(); ++i) {
    const Eigen::Vector3d s = pairs.seen[i] - seen_mean, f = pairs.felt[i] - felt_mean;
    cross += s * f.transpose();
    seen2 += s.squaredNorm();
    felt2 += f.squaredNorm();
  }
  Match out;
  if (solve_rotation) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0);
    out.R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  const double along = (out.R.transpose() * cross).trace();
  if (solve_scale) out.scale = felt2 > 0.0 && along > 0.0 ? along / felt2 : 1.0;
  out.cost = seen2 > 0.0 ? (seen2 - 2.0 * out.scale * along + out.scale * out.scale * felt2) / seen2 : 1.0;
  out.bias = out.scale * (out.R * felt_mean) - seen_mean;
  out.motion = std::sqrt(seen2 / n);
  return out;
}

template <class PairsAt>
LatencyScan scan_latencies(const LatencyConfig& config, bool solve_rotation, bool solve_scale, PairsAt pairs_at) {
  LatencyScan out;
  Match best;
  double least = std::numeric_limits<double>::infinity();
  const double range_s = config.largest_latency_s - config.least_latency_s;
  const auto steps = static_cast<std::size_t>(std::min(1e5, std::ceil(range_s / config.scan_step_s)));
  for (std::size_t i = 0; i <= steps; ++i) {
    const double latency_s = config.least_latency_s + range_s * static_cast<double>(i) / static_cast<double>(steps);
    const Pairs pairs = pairs_at(latency_s);
    const Match here = match_pairs(pairs, solve_rotation, solve_scale);
    out.rows = pairs.seen.size();
    out.latency_s.push_back(latency_s);
    out.cost.push_back(here.cost);
    if (here.cost < least) {
      least = here.cost;
      best = here;
      out.best = i;
    }
  }
  out.at_edge = out.best == 0 || out.best == steps;
  out.runner_up = out.best;
  double second = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < steps; ++i) {
    const bool dip = out.cost[i] <= out.cost[i - 1] && out.cost[i] <= out.cost[i + 1];
    // Noise makes small dips beside the best one; a rival has a ridge between.
    if (!dip || i == out.best || out.cost[i] >= second) continue;
    const auto [from, to] = std::minmax(i, out.best);
    const double ridge = *std::max_element(out.cost.begin() + static_cast<std::ptrdiff_t>(from),
                                           out.cost.begin() + static_cast<std::ptrdiff_t>(to));
    constexpr double kRidge = 0.02;
    if (ridge - out.cost[i] < kRidge) continue;
    second = out.cost[i];
    out.runner_up = i;
  }
  out.R_marker_sensor = Eigen::Quaterniond(best.R);
  out.scale = best.scale;
  out.bias = best.bias;
  out.motion = best.motion;
  return out;
}

// The sensor's signal integrated once and twice from its first row.
struct Integrals {
  std::vector<Eigen::Vector3d> once, twice;
};

Integrals integrate_sensor(const SensorSeries& sensor) {
  Integrals out;
  out.once.resize(sensor.x.size(), Eigen::Vector3d::Zero());
  out.twice = out.once;
  for (std::size_t i = 1; i < sensor.x.size(); ++i) {
    const double step_s = sensor.t_s[i] - sensor.t_s[i - 1];
    out.once[i] = out.once[i - 1] + 0.5 * step_s * (sensor.x[i - 1] + sensor.x[i]);
    out.twice[i] =
        out.twice[i - 1] + step_s * out.once[i - 1] + step_s * step_s / 6.0 * (2.0 * sensor.x[i - 1] + sensor.x[i]);
  }
  return out;
}

struct At {
  Eigen::Vector3d once, twice;
};

At integral_at(const SensorSeries& sensor, const Integrals& integrals, double t_s, std::size_t& row) {
  if (sensor.t_s[row] > t_s) row = 0;
  row = row_before(sensor.t_s, t_s, row);
  const double part_s = t_s - sensor.t_s[row], step_s = sensor.t_s[row + 1] - sensor.t_s[row];
  const Eigen::Vector3d slope = (sensor.x[row + 1] - sensor.x[row]) / step_s;
  return {integrals.once[row] + part_s * (sensor.x[row] + 0.5 * part_s * slope),
          integrals.twice[row] + part_s * integrals.once[row] +
              part_s * part_s * (0.5 * sensor.x[row] + part_s / 6.0 * slope)};
}

// The rows whose motion is no more than a few times the median: a pose that flips would drown all others.
std::vector<bool> plausible(const std::vector<Eigen::Vector3d>& seen) {
  constexpr double kMost = 6.0;
  std::vector<bool> out(seen.size(), true);
  if (seen.empty()) return out;
  Eigen::Vector3d middle;
  std::vector<double> one(seen.size());
  const auto median = [&] {
    const auto at = one.begin() + static_cast<std::ptrdiff_t>(one.size() / 2);
    std::nth_element(one.begin(), at, one.end());
    return *at;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < seen.size(); ++i) one[i] = seen[i][axis];
    middle[axis] = median();
  }
  for (std::size_t i = 0; i < seen.size(); ++i) one[i] = (seen[i] - middle).norm();
  const double limit = kMost * median();
  for (std::size_t i = 0; i < seen.size(); ++i) out[i] = (seen[i] - middle).norm() <= limit;
  return out;
}

double median_step_s(const std::vector<double>& t_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t_s.size(); ++i) steps.push_back(t_s[i] - t_s[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

}  // namespace

LatencyScan scan_gyroscope(const SensorSeries& sensor, const PoseSeries& poses, const LatencyConfig& config,
                           bool solve_rotation, bool solve_scale) {
  const Integrals integrals = integrate_sensor(sensor);
  const double longest_s = 3.0 * median_step_s(poses.t_s);
  std::vector<Eigen::Vector3d> turns(poses.t_s.size(), Eigen::Vector3d::Zero());  // rad/s, since the pose before
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const auto turn = poses.T_world_marker[i - 1].rotation.conjugate() * poses.T_world_marker[i].rotation;
    turns[i] = log_rotation(turn) / (poses.t_s[i] - poses.t_s[i - 1]);
  }
  const std::vector<bool> good = plausible(turns);
  return scan_latencies(config, solve_rotation, solve_scale, [&](double latency_s) {
    Pairs pairs;
    std::size_t row = 0;
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < poses.t_s.size(); ++i) {
      const Eigen::Vector3d now = integral_at(sensor, integrals, poses.t_s[i] - latency_s, row).once;
      const double step_s = i > 0 ? poses.t_s[i] - poses.t_s[i - 1] : 0.0;
      if (i > 0 && good[i] && poses.starts[i] == 0 && step_s <= longest_s) {
        pairs.seen.push_back(turns[i]);
        pairs.felt.push_back((now - before) / step_s);
      }
      before = now;
    }
    return pairs;
  });
}

LatencyScan scan_accelerometer(const SensorSeries& sensor, const PoseSeries& poses, const PoseInterpolator& tracker,
                               const Eigen::Vector3d& lever_arm_m, const Eigen::Vector3d& gravity_world_mps2,
                               const LatencyConfig& config, bool solve_rotation) {
  const Integrals integrals = integrate_sensor(sensor);
  // A second difference over 2 h is the mean acceleration under a triangle of that base: long enough to quiet the
  // poses' noise.
  const double h = std::max(0.04, 2.0 * median_step_s(poses.t_s));
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> seen;
  PoseInterpolator::Cursor cursor;
  for (std::size_t i = 0; i < poses.t_s.size(); ++i) {
    const double at = poses.t_s[i];
    if (at - h < tracker.first_s() || at + h > tracker.last_s()) continue;
    if (at - h - config.largest_latency_s < sensor.t_s.front() || at + h - config.least_latency_s > sensor.t_s.back())
      continue;
    const Pose before = tracker.at(at - h, cursor), here = tracker.at(at, cursor), after = tracker.at(at + h, cursor);
    const Eigen::Vector3d bend = before * lever_arm_m - 2.0 * (here * lever_arm_m) + after * lever_arm_m;
    t_s.push_back(at);
    seen.push_back(here.rotation.conjugate() * (bend / (h * h) - gravity_world_mps2));
  }
  const std::vector<bool> good = plausible(seen);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!good[i]) continue;
    seen[kept] = seen[i];
    t_s[kept++] = t_s[i];
  }
  seen.resize(kept);
  t_s.resize(kept);
  return scan_latencies(config, solve_rotation, false, [&](double latency_s) {
    Pairs pairs{seen, {}};
    std::size_t before = 0, here = 0, after = 0;
    for (const double at : t_s) {
      pairs.felt.push_back((integral_at(sensor, integrals, at - h - latency_s, before).twice -
                            2.0 * integral_at(sensor, integrals, at - latency_s, here).twice +
                            integral_at(sensor, integrals, at + h - latency_s, after).twice) /
                           (h * h));
    }
    return pairs;
  });
}

}  // namespace asperity
