#include "asperity/calibration/find_static_poses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestRows = 20;
constexpr double kMotion = std::numeric_limits<double>::infinity();

void check_static_samples(const AccelerometerSamples& samples) {
  if (samples.counts.size() != samples.size()) {
    throw Error(fmt::format("accelerometer: {} times, but {} readings", samples.size(), samples.counts.size()));
  }
  if (samples.size() < kFewestRows) {
    throw Error(
        fmt::format("accelerometer: {} readings are too few to find poses in: hold the probe still for two "
                    "seconds each in a few dozen directions",
                    samples.size()));
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples.counts[i].allFinite() || !std::isfinite(samples.t_s[i])) {
      throw Error(fmt::format("accelerometer: reading {} is not finite", i + 1));
    }
    if (i > 0 && !(samples.t_s[i] > samples.t_s[i - 1])) {
      throw Error(fmt::format("accelerometer: the time of reading {} does not rise", i + 1));
    }
  }
}

// The variance that rounding leaves in readings that do not move at all: a twelfth of the smallest step squared.
double rounding_variance(const std::vector<Eigen::Vector3d>& counts) {
  Eigen::Vector3d step = Eigen::Vector3d::Constant(kMotion);
  for (std::size_t i = 1; i < counts.size(); ++i) {
    const Eigen::Vector3d change = (counts[i] - counts[i - 1]).cwiseAbs();
    for (int axis = 0; axis < 3; ++axis) {
      if (change[axis] > 0.0) step[axis] = std::min(step[axis], change[axis]);
    }
  }
  double out = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(step[axis])) out += step[axis] * step[axis] / 12.0;
  }
  return out;
}

// The variance in the window round each row; kMotion where rows are missing.
std::vector<double> window_variances(const AccelerometerSamples& samples, double window_s, double period_s) {
  const std::size_t n = samples.size();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& counts : samples.counts) mean += counts / static_cast<double>(n);
  std::vector<Eigen::Vector3d> sum(n + 1, Eigen::Vector3d::Zero());
  std::vector<double> square(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d counts = samples.counts[i] - mean;
    sum[i + 1] = sum[i] + counts;
    square[i + 1] = square[i] + counts.squaredNorm();
  }
  const double rows_expected = window_s / period_s;
  const double floor = rounding_variance(samples.counts);
  std::vector<double> out(n, kMotion);
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (samples.t_s[first] < samples.t_s[i] - 0.5 * window_s) ++first;
    while (last < n && samples.t_s[last] <= samples.t_s[i] + 0.5 * window_s) ++last;
    const auto rows = static_cast<double>(last - first);
    if (rows < 5.0 || rows < 0.7 * rows_expected) continue;
    const double scatter = square[last] - square[first] - (sum[last] - sum[first]).squaredNorm() / rows;
    out[i] = std::max(scatter, 0.0) / (rows - 1.0) + floor;
  }
  return out;
}

struct Threshold {
  double variance = 0.0;
  double noise_variance = 0.0;
};

// Otsu's threshold of log variances.
Threshold part(std::vector<double> variances) {
  std::vector<double> logs;
  logs.reserve(variances.size());
  for (const double variance : variances) {
    if (variance > 0.0) logs.push_back(std::log(variance));
  }
  if (logs.empty()) return {};
  std::sort(logs.begin(), logs.end());
  double all = 0.0;
  for (const double value : logs) all += value;
  const auto n = static_cast<double>(logs.size());
  double below = 0.0;
  double best = -1.0;
  std::size_t quiet = logs.size();
  for (std::size_t i = 1; i < logs.size(); ++i) {
    below += logs[i - 1];
    const auto count = static_cast<double>(i);
    const double gap = below / count - (all - below) / (n - count);
    const double between = count * (n - count) * gap * gap;
    if (between > best) {
      best = between;
      quiet = i;
    }
  }
  Threshold out;
  out.noise_variance = std::exp(logs[quiet / 2]);
  const double edge = quiet < logs.size() ? 0.5 * (logs[quiet - 1] + logs[quiet]) : logs.back();
  out.variance = std::max(std::exp(edge), 4.0 * out.noise_variance);
  return out;
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& values, std::size_t first, std::size_t last) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

void describe_pose(StaticPose& pose, const AccelerometerSamples& samples) {
  pose.start_s = samples.t_s[pose.first];
  pose.duration_s = samples.t_s[pose.last - 1] - pose.start_s;
  pose.mean_counts = mean_of(samples.counts, pose.first, pose.last);
  const std::size_t middle = (pose.first + pose.last) / 2;
  pose.drift_counts = (mean_of(samples.counts, pose.first, middle) - mean_of(samples.counts, middle, pose.last)).norm();
}

double measure_spread(const std::vector<StaticPose>& poses) {
  if (poses.empty()) return 0.0;
  const auto n = static_cast<double>(poses.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const StaticPose& pose : poses) mean += pose.mean_counts / n;
  double square = 0.0;
  for (const StaticPose& pose : poses) square += (pose.mean_counts - mean).squaredNorm() / n;
  return std::sqrt(square);
}

// A rest that a tremor has cut in two would otherwise count twice with one error.
std::vector<StaticPose> join_poses(const std::vector<StaticPose>& poses, const AccelerometerSamples& samples,
                                   double nearer_counts) {
  std::vector<StaticPose> out;
  for (const StaticPose& pose : poses) {
    if (out.empty() || (out.back().mean_counts - pose.mean_counts).norm() >= nearer_counts) {
      out.push_back(pose);
      continue;
    }
    StaticPose& before = out.back();
    const auto a = static_cast<double>(before.last - before.first);
    const auto b = static_cast<double>(pose.last - pose.first);
    before.mean_counts = (a * before.mean_counts + b * pose.mean_counts) / (a + b);
    before.drift_counts = std::max(before.drift_counts, pose.drift_counts);
    before.last = pose.last;
    before.duration_s = samples.t_s[pose.last - 1] - before.start_s;
  }
  return out;
}

}  // namespace

StaticPoses find_static_poses(const AccelerometerSamples& samples, const FindStaticPosesConfig& config) {
  check_static_samples(samples);
  std::vector<double> steps_s(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) steps_s[i] = samples.t_s[i + 1] - samples.t_s[i];
  const double period_s = median(steps_s);
  const std::vector<double> variance = window_variances(samples, config.window_s, period_s);

  std::vector<double> apart;
  double next_s = samples.t_s.front();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.t_s[i] < next_s || !std::isfinite(variance[i])) continue;
    apart.push_back(variance[i]);
    next_s = samples.t_s[i] + 0.5 * config.window_s;
  }
  const Threshold found = part(std::move(apart));
  const double threshold = config.still_counts > 0.0 ? config.still_counts * config.still_counts : found.variance;

  StaticPoses out;
  out.still_counts = std::sqrt(threshold);
  out.noise_counts = std::sqrt(found.noise_variance);
  std::vector<StaticPose> rests;
  for (std::size_t i = 0; i < samples.size();) {
    if (!(variance[i] <= threshold)) {
      ++i;
      continue;
    }
    StaticPose pose;
    pose.first = i;
    while (i < samples.size() && variance[i] <= threshold) ++i;
    pose.last = i;
    if (samples.t_s[pose.last - 1] - samples.t_s[pose.first] < config.shortest_s) continue;
    describe_pose(pose, samples);
    rests.push_back(pose);
  }
  out.poses = join_poses(rests, samples, config.same_pose * measure_spread(rests));
  out.radius_counts = measure_spread(out.poses);
  return out;
}

}  // namespace asperity
