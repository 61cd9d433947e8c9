#include "asperity/profile/thesis_steps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/moving_average.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {

std::vector<double> path_length_m(std::span<const Eigen::Vector3d> p_m) {
  std::vector<double> s_m(p_m.size(), 0.0);
  for (std::size_t i = 1; i < p_m.size(); ++i) s_m[i] = s_m[i - 1] + (p_m[i] - p_m[i - 1]).norm();
  return s_m;
}

std::vector<double> blend_acceleration(std::span<const Eigen::Vector3d> a_world_tip_mps2,
                                       std::span<const Eigen::Vector3d> n_world) {
  if (a_world_tip_mps2.size() != n_world.size()) {
    throw Error("acceleration blending: " + std::to_string(a_world_tip_mps2.size()) + " accelerations but " +
                std::to_string(n_world.size()) + " normals");
  }
  std::vector<double> a_normal_mps2(n_world.size());
  for (std::size_t i = 0; i < n_world.size(); ++i) a_normal_mps2[i] = a_world_tip_mps2[i].dot(n_world[i]);
  return a_normal_mps2;
}

std::vector<double> force_scale(std::span<const double> force_N, std::size_t half_width) {
  std::vector<double> scale(force_N.size(), 1.0);
  const std::vector<double> bridged_N = bridge_gaps(force_N);
  if (bridged_N.empty() || std::isnan(bridged_N.front())) return scale;
  const auto [least, most] = std::minmax_element(bridged_N.begin(), bridged_N.end());
  if (*least == *most) return scale;  // before the average's rounding makes a range of it
  const std::vector<double> smooth_N = moving_average(bridged_N, half_width);
  const auto [low, high] = std::minmax_element(smooth_N.begin(), smooth_N.end());
  const double range_N = *high - *low;
  if (!(range_N > 0.0)) return scale;
  const double mean_N = mean(smooth_N);
  for (std::size_t i = 0; i < scale.size(); ++i) scale[i] = 1.0 - (smooth_N[i] - mean_N) / range_N;
  return scale;
}

std::vector<double> integrate_verlet(std::span<const double> a_mps2, double period_s) {
  if (!(period_s > 0.0)) throw Error("Verlet integration: period " + number_text(period_s) + " s is not positive");
  std::vector<double> h_m(a_mps2.size());
  if (h_m.empty()) return h_m;
  const double dt2 = period_s * period_s;
  double step_m = -0.5 * a_mps2[0] * dt2;  // from rest: the step before the first mirrors the one after it
  double now_m = 0.0;
  for (std::size_t i = 0; i < h_m.size(); ++i) {
    h_m[i] = now_m;
    step_m += a_mps2[i] * dt2;
    now_m += step_m;
  }
  return h_m;
}

std::vector<char> mark_stick_slip(std::span<const Eigen::Vector3d> v_world_tip_mps,
                                  std::span<const Eigen::Vector3d> n_world, double min_speed_mps) {
  if (v_world_tip_mps.size() != n_world.size()) {
    throw Error("stick and slip: " + std::to_string(v_world_tip_mps.size()) + " velocities but " +
                std::to_string(n_world.size()) + " normals");
  }
  std::vector<char> moving(n_world.size());
  for (std::size_t i = 0; i < n_world.size(); ++i) {
    const Eigen::Vector3d along_mps = v_world_tip_mps[i] - v_world_tip_mps[i].dot(n_world[i]) * n_world[i];
    moving[i] = along_mps.norm() >= min_speed_mps ? 1 : 0;
  }
  return moving;
}

}  // namespace asperity
