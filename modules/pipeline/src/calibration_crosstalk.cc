#include "calibration_crosstalk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "asperity/base/units.h"
#include "asperity/geometry/pose.h"
#include "asperity/signal/spectrum.h"
#include "normal_leak.h"

namespace asperity {

namespace {

constexpr double kStretch_s = 1.3;  // at least: of a length whose transform is fast
constexpr double kLongestStep_s = 0.05;

struct Run {
  std::size_t first = 0, last = 0;
};

std::vector<Run> find_runs(const TipMotion& motion, std::span<const char> moving) {
  std::vector<Run> out;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i] == 0) continue;
    const bool goes_on = !out.empty() && out.back().last == i &&
                         static_cast<double>(motion.t_ns[i] - motion.t_ns[i - 1]) * kNanosecond_s <= kLongestStep_s;
    if (!goes_on) out.push_back({i, i});
    out.back().last = i + 1;
  }
  return out;
}

// The density of a signal of the samples, over all runs that hold a stretch.
template <class Signal>
void add_density(const std::vector<Run>& runs, double rate_Hz, std::size_t stretch, double factor, bool integrate_twice,
                 const Signal& signal, HeightErrors& errors) {
  if (!(factor > 0.0)) return;
  std::size_t segments = 0;
  PowerSpectrum sum;
  for (const Run& run : runs) {
    if (run.last - run.first < stretch) continue;
    std::vector<double> x(run.last - run.first);
    for (std::size_t i = run.first; i < run.last; ++i) x[i - run.first] = signal(i);
    // Gravity and the mean direction are not carried as waves.
    const double n = static_cast<double>(x.size() - 1), slope = (x.back() - x.front()) / n, begin = x.front();
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= begin + slope * static_cast<double>(i);
    const PowerSpectrum one = welch(x, rate_Hz, stretch);
    if (sum.density.empty()) {
      sum.frequency = one.frequency;
      sum.density.assign(one.density.size(), 0.0);
    }
    for (std::size_t k = 0; k < sum.density.size(); ++k)
      sum.density[k] += static_cast<double>(one.segments) * one.density[k];
    segments += one.segments;
  }
  if (segments == 0) return;
  if (errors.crosstalk_Hz.empty()) {
    errors.crosstalk_Hz = sum.frequency;
    errors.crosstalk_m2ps.assign(sum.density.size(), 0.0);
  }
  for (std::size_t k = 1; k < sum.density.size(); ++k) {
    const double omega = 2.0 * std::numbers::pi * sum.frequency[k];
    const double gain = integrate_twice ? 1.0 / (omega * omega * omega * omega) : 1.0;
    errors.crosstalk_m2ps[k] += factor * gain * sum.density[k] / static_cast<double>(segments);
  }
}

}  // namespace

void add_crosstalk(const TipMotion& motion, const BasePath& base, std::span<const char> moving,
                   const Eigen::Vector3d& gravity_world_mps2, const CalibrationErrors& calibration, double lean_rad,
                   HeightErrors& errors) {
  const std::size_t n = motion.size();
  if (n < 3 || base.size() != n || moving.size() != n) return;
  const double rate_Hz =
      static_cast<double>(n - 1) / (static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s);
  const auto stretch = smooth_length(static_cast<std::size_t>(std::lround(kStretch_s * rate_Hz)));
  const std::vector<Run> runs = find_runs(motion, moving);
  if (stretch < 8) return;

  const OffBase off = off_base(motion, base);
  const auto swaying = [&](std::size_t k) { return off.sway_m[k]; };
  add_density(runs, rate_Hz, stretch, std::pow(std::tan(lean_rad), 2), false, swaying, errors);
  errors.leaning_m2ps = std::exchange(errors.crosstalk_m2ps, std::vector<double>(errors.crosstalk_m2ps.size(), 0.0));

  // In the marker's frame: the normals, and the specific force across them (what is along the normal itself is a gain
  // of the heights, not another signal); and how the marker is turned from its middle orientation.
  std::vector<Eigen::Vector3d> normal(n), across(n), turn(n);
  const Eigen::Quaterniond from_middle = motion.q_world_marker[n / 2].conjugate();
  for (std::size_t k = 0; k < n; ++k) {
    if (moving[k] == 0 && k != n / 2) continue;
    const Eigen::Matrix3d R_marker_world = motion.q_world_marker[k].conjugate().toRotationMatrix();
    const Eigen::Vector3d force = motion.a_world_tip_mps2[k] - gravity_world_mps2;
    normal[k] = R_marker_world * base.n_world[k];
    across[k] = R_marker_world * (force - base.n_world[k] * base.n_world[k].dot(force));
    turn[k] = log_rotation(from_middle * motion.q_world_marker[k]);
  }
  const double lever2 = calibration.tip_from_sensor_m.cross(normal[n / 2]).squaredNorm();
  const double accel2 = std::pow(calibration.accel_matrix, 2), gyro2 = std::pow(calibration.gyro_matrix, 2);
  const auto add = [&](double factor, bool integrate_twice, const auto& signal) {
    add_density(runs, rate_Hz, stretch, factor, integrate_twice, signal, errors);
  };
  for (Eigen::Index j = 0; j < 3; ++j) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      add(accel2, true, [&](std::size_t k) { return normal[k][i] * across[k][j]; });
    }
    add(gyro2 * lever2, false, [&](std::size_t k) { return turn[k][j]; });
    add(calibration.tip_m[j] * calibration.tip_m[j], false, [&](std::size_t k) { return normal[k][j]; });
  }
}

}  // namespace asperity
