#include "pair_rates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "asperity/base/units.h"
#include "asperity/import/pose_noise.h"
#include "pose_at.h"
#include "running_integral.h"

namespace asperity {

namespace {

// A pose with the gyroscope's rotation since the beginning of its section. A section has the gyroscope all along.
struct PairedPose {
  std::int64_t t_ns = 0;
  Eigen::Quaterniond pose, gyro;
  Eigen::Vector3d angle_rad;  // the gyroscope's rates, summed up as they are
  std::size_t section = 0;
};

double median_of(std::array<double, 17>& values, std::size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

// Far from the median of the eight poses to either side, in an axis.
bool is_outlying(const PoseStream& pose, std::size_t i, double sigma_rad) {
  constexpr std::size_t kReach = 8;
  constexpr double kOutlying = 6.0;  // standard deviations of the poses, or of what the neighbours spread over
  const std::size_t first = i - std::min(i, kReach), last = std::min(i + kReach + 1, pose.size());
  std::array<Eigen::Vector3d, 2 * kReach + 1> away;
  const std::size_t count = last - first;
  for (std::size_t k = first; k < last; ++k) {
    away[k - first] = log_rotation(pose.T_world_body[i].rotation.conjugate() * pose.T_world_body[k].rotation);
  }
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 2 * kReach + 1> values{};
    for (std::size_t k = 0; k < count; ++k) values[k] = away[k][axis];
    const double middle = median_of(values, count);
    for (std::size_t k = 0; k < count; ++k) values[k] = std::abs(away[k][axis] - middle);
    constexpr double kGaussian = 1.48;
    if (std::abs(middle) > kOutlying * std::max(sigma_rad, kGaussian * median_of(values, count))) return true;
  }
  return false;
}

// The gyroscope's rotation over an interval, in steps over which it is nearly about one axis.
std::optional<Eigen::Quaterniond> gyro_rotation(const RunningIntegral& turned, std::int64_t from_ns,
                                                std::int64_t to_ns) {
  constexpr std::int64_t kStep_ns = 5'000'000;
  const std::int64_t steps = std::max<std::int64_t>(1, (to_ns - from_ns + kStep_ns - 1) / kStep_ns);
  Eigen::Quaterniond out = Eigen::Quaterniond::Identity();
  for (std::int64_t k = 0; k < steps; ++k) {
    const auto angle =
        turned.between(from_ns + (to_ns - from_ns) * k / steps, from_ns + (to_ns - from_ns) * (k + 1) / steps);
    if (!angle) return std::nullopt;
    out = out * exp_rotation(*angle);
  }
  return out.normalized();
}

std::vector<PairedPose> paired_poses(const PoseStream& pose, const VectorStream& rate, double sigma_rad) {
  constexpr std::int64_t kGapIntervals = 10;
  const std::int64_t longest_ns = kGapIntervals * median_interval_ns(pose.t_ns);
  const RunningIntegral turned(rate.t_ns, rate.value);
  std::vector<PairedPose> out;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (pose.t_ns[i] < rate.t_ns.front() || pose.t_ns[i] > rate.t_ns.back()) continue;
    if (is_outlying(pose, i, sigma_rad)) continue;
    PairedPose now{pose.t_ns[i], pose.T_world_body[i].rotation, Eigen::Quaterniond::Identity(),
                   *turned.to(pose.t_ns[i]), 0};
    if (!out.empty()) {
      const PairedPose& before = out.back();
      now.section = before.section;
      const bool far = now.t_ns - before.t_ns > longest_ns;
      const auto turn = far ? std::nullopt : gyro_rotation(turned, before.t_ns, now.t_ns);
      if (turn) now.gyro = before.gyro * *turn;
      if (!turn) ++now.section;
    }
    out.push_back(now);
  }
  return out;
}

// The mean over the rows of one stretch.
struct StretchMean {
  double t_s = 0.0;
  Eigen::Quaterniond pose, gyro;
  Eigen::Vector3d angle_rad = Eigen::Vector3d::Zero();
  double count = 0.0;
  std::size_t section = 0;
};

StretchMean mean_over(const std::vector<PairedPose>& rows, std::size_t first, std::size_t last, std::int64_t from_ns) {
  StretchMean out;
  Eigen::Vector4d pose = Eigen::Vector4d::Zero(), gyro = Eigen::Vector4d::Zero();
  const auto add = [](const Eigen::Quaterniond& q, const Eigen::Quaterniond& near, Eigen::Vector4d& sum) {
    sum += q.dot(near) < 0.0 ? Eigen::Vector4d(-q.coeffs()) : Eigen::Vector4d(q.coeffs());
  };
  out.count = static_cast<double>(last - first);
  for (std::size_t i = first; i < last; ++i) {
    add(rows[i].pose, rows[first].pose, pose);
    add(rows[i].gyro, rows[first].gyro, gyro);
    out.angle_rad += rows[i].angle_rad / out.count;
    out.t_s += static_cast<double>(rows[i].t_ns - from_ns) * kNanosecond_s / out.count;
  }
  out.pose = Eigen::Quaterniond(pose).normalized();
  out.gyro = Eigen::Quaterniond(gyro).normalized();
  out.section = rows[first].section;
  return out;
}

RatePairs pairs_over(const std::vector<PairedPose>& rows, std::int64_t stretch_ns, std::int64_t interval_ns,
                     double sigma_rad) {
  RatePairs out;
  out.stretch_s = static_cast<double>(stretch_ns) * kNanosecond_s;
  out.pose_noise_rad = sigma_rad;
  constexpr double kLeastShare = 0.6;  // of the poses that a stretch would have
  const double least = kLeastShare * static_cast<double>(stretch_ns) / static_cast<double>(interval_ns);
  std::optional<StretchMean> before;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first + 1;
    while (last < rows.size() && rows[last].t_ns - rows[first].t_ns < stretch_ns &&
           rows[last].section == rows[first].section) {
      ++last;
    }
    const StretchMean now = mean_over(rows, first, last, rows.front().t_ns);
    first = last;
    if (now.count < least) {
      before.reset();
      continue;
    }
    if (before && before->section == now.section && now.t_s - before->t_s < 2.0 * out.stretch_s) {
      const double between_s = now.t_s - before->t_s;
      out.pose_radps.push_back(log_rotation(before->pose.conjugate() * now.pose) / between_s);
      // A gyroscope in a wrong unit rotates by more than half a turn from one mean to the next, which no rotation
      // shows.
      constexpr double kWraps_rad = 2.0;
      const Eigen::Vector3d angle_rad = now.angle_rad - before->angle_rad;
      out.gyro_radps.push_back(
          (angle_rad.norm() > kWraps_rad ? angle_rad : log_rotation(before->gyro.conjugate() * now.gyro)) / between_s);
      out.noise2 += 3.0 * sigma_rad * sigma_rad * (1.0 / before->count + 1.0 / now.count) / (between_s * between_s);
    }
    before = now;
  }
  return out;
}

// Of the rotation's power over that of the noise.
double signal_to_noise(const RatePairs& pairs) {
  double power = 0.0;
  for (const Eigen::Vector3d& rate : pairs.pose_radps) power += rate.squaredNorm();
  return pairs.noise2 > 0.0 ? (power - pairs.noise2) / pairs.noise2 : HUGE_VAL;
}

}  // namespace

RatePairs pair_rates(const PoseStream& pose, const VectorStream& rate) {
  if (pose.size() < 2 || rate.size() < 2) return {};
  constexpr std::int64_t kShortest_ns = 40'000'000, kLongest_ns = 1'280'000'000;
  constexpr double kStandsOut = 10.0;
  constexpr std::size_t kLeastPairs = 20;
  const std::int64_t interval_ns = std::max<std::int64_t>(1, median_interval_ns(pose.t_ns));
  const double sigma_rad = estimate_pose_noise(pose).rotation_rad.norm() / std::sqrt(3.0);
  const std::vector<PairedPose> rows = paired_poses(pose, rate, sigma_rad);
  std::int64_t stretch_ns = std::max(kShortest_ns, 2 * interval_ns);
  RatePairs best = pairs_over(rows, stretch_ns, interval_ns, sigma_rad);
  double most = signal_to_noise(best);
  for (stretch_ns *= 2; most < kStandsOut && stretch_ns <= kLongest_ns; stretch_ns *= 2) {
    RatePairs longer = pairs_over(rows, stretch_ns, interval_ns, sigma_rad);
    if (longer.pose_radps.size() < kLeastPairs) break;
    const double ratio = signal_to_noise(longer);
    if (ratio <= most) continue;
    most = ratio;
    best = std::move(longer);
  }
  return best;
}

}  // namespace asperity
