#include "gyroscope_model.h"

#include <cmath>
#include <limits>

namespace asperity {

namespace {

// The sensor's orientation since its first sample, and the integrals over it that the slopes need.
struct Integral {
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d by_bias = Eigen::Matrix3d::Zero();      // ∫ R
  Eigen::Matrix3d by_rotation = Eigen::Matrix3d::Zero();  // ∫ R [ω]×
  Eigen::Vector3d by_scale = Eigen::Vector3d::Zero();     // ∫ R ω
};

// One step from rate a to rate b with the given mean, with the bias taken off and (`raw_mean`) not; Magnus' series to
// the fourth order for a rate that is nearly linear in time.
void advance_rotation_integral(Integral& s, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& mean, const Eigen::Vector3d& raw_mean, double step_s) {
  const Eigen::Vector3d angle = step_s * mean + step_s * step_s / 12.0 * a.cross(b);
  const Eigen::Matrix3d R_middle = (s.R * exp_rotation(0.5 * angle)).toRotationMatrix();
  s.by_bias += step_s * R_middle;
  s.by_rotation += step_s * R_middle * skew(raw_mean);
  s.by_scale += step_s * R_middle * raw_mean;
  s.R = (s.R * exp_rotation(angle)).normalized();
}

// The mean from each sample to the next by the cubic through four samples: the trapezoid would shorten every swing by
// the square of its phase per sample over twelve, which a solved scale would take up. Uneven steps keep the trapezoid.
std::vector<Eigen::Vector3d> step_means(const SensorSeries& sensor) {
  constexpr double kEven = 0.2;
  const auto& t = sensor.t_s;
  const auto& x = sensor.x;
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    out.push_back(0.5 * (x[i] + x[i + 1]));
    if (i == 0 || i + 2 >= x.size()) continue;
    const double step = t[i + 1] - t[i];
    if (std::abs(t[i] - t[i - 1] - step) > kEven * step || std::abs(t[i + 2] - t[i + 1] - step) > kEven * step)
      continue;
    out.back() = (13.0 * (x[i] + x[i + 1]) - x[i - 1] - x[i + 2]) / 24.0;
  }
  return out;
}

}  // namespace

GyroscopeModel::GyroscopeModel(const SensorSeries& sensor, const PoseSeries& poses, bool solve_rotation,
                               bool solve_scale)
    : sensor_(sensor),
      poses_(poses),
      solve_rotation_(solve_rotation),
      solve_scale_(solve_scale),
      noise_rate_(integral_noise_rate(sensor)),
      step_mean_(step_means(sensor)) {}

LatencyRows GyroscopeModel::rows() const {
  const std::size_t poses = poses_.t_s.size();
  LatencyRows out;
  out.residual.resize(static_cast<Eigen::Index>(3 * poses));
  out.slopes.resize(static_cast<Eigen::Index>(3 * poses), parameters());
  const Eigen::Matrix3d M = scale * R_marker_sensor.toRotationMatrix();
  Integral at;
  std::size_t row = 0;
  Eigen::Vector3d raw = M * sensor_.x[0];
  Eigen::Quaterniond R_world_start;  // of the integral's first frame in the world
  for (std::size_t i = 0; i < poses; ++i) {
    const double t_s = poses_.t_s[i] - latency_s;
    const std::size_t target = row_before(sensor_.t_s, t_s, row);
    for (; row < target; ++row) {
      const Eigen::Vector3d next = M * sensor_.x[row + 1];
      const Eigen::Vector3d mean = M * step_mean_[row];
      advance_rotation_integral(at, raw - bias_radps, next - bias_radps, mean - bias_radps, mean,
                                sensor_.t_s[row + 1] - sensor_.t_s[row]);
      raw = next;
    }
    const double part_s = t_s - sensor_.t_s[row];
    const double share = part_s / (sensor_.t_s[row + 1] - sensor_.t_s[row]);
    const Eigen::Vector3d here = raw + share * (M * sensor_.x[row + 1] - raw);
    Integral there = at;
    const Eigen::Vector3d middle = 0.5 * (raw + here);
    advance_rotation_integral(there, raw - bias_radps, here - bias_radps, middle - bias_radps, middle, part_s);
    if (poses_.starts[i] != 0) R_world_start = poses_.T_world_marker[i].rotation * there.R.conjugate();
    const Eigen::Matrix3d world = R_world_start.toRotationMatrix();
    const Eigen::Quaterniond predicted = R_world_start * there.R;
    const auto k = static_cast<Eigen::Index>(3 * i);
    out.residual.segment<3>(k) = log_rotation(poses_.T_world_marker[i].rotation * predicted.conjugate());
    out.slopes.block<3, 1>(k, 0) = predicted * (here - bias_radps);
    out.slopes.block<3, 3>(k, 1) = world * there.by_bias;
    int column = 4;
    if (solve_rotation_) {
      out.slopes.block<3, 3>(k, column) = world * there.by_rotation;
      column += 3;
    }
    if (solve_scale_) out.slopes.block<3, 1>(k, column) = -(world * there.by_scale);
  }
  return out;
}

void GyroscopeModel::step(const Eigen::VectorXd& delta) {
  latency_s += delta[0];
  bias_radps += delta.segment<3>(1);
  if (solve_rotation_) R_marker_sensor = (exp_rotation(delta.segment<3>(4)) * R_marker_sensor).normalized();
  if (solve_scale_) scale *= 1.0 + delta[delta.size() - 1];
}

Eigen::VectorXd GyroscopeModel::prior_sigma() const {
  return Eigen::VectorXd::Constant(parameters(), std::numeric_limits<double>::infinity());
}

}  // namespace asperity
