#include "asperity/fidelity/stroke_signals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/signal/moving_average.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

constexpr double kSpeedWindow_s = 0.1, kMoving = 0.5, kTangent_m = 0.5e-3;

bool any_finite(const std::vector<double>& x) {
  return std::any_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

// Unit tangents of the path, in the direction of travel, over half a millimetre.
std::vector<Vector3d> tangents(const BasePath& path) {
  const std::size_t n = path.size();
  std::vector<Vector3d> out(n, Vector3d::Zero());
  std::size_t before = 0, after = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (before + 1 < i && path.s_m[i] - path.s_m[before + 1] >= 0.5 * kTangent_m) ++before;
    after = std::max(after, i);
    while (after + 1 < n && path.s_m[after] - path.s_m[i] < 0.5 * kTangent_m) ++after;
    const Vector3d step_m = path.p_world_m[after] - path.p_world_m[before];
    if (step_m.norm() > 0.0) out[i] = step_m.normalized();
  }
  return out;
}

}  // namespace

StrokeSignals measure_stroke(const ProcessResult& result, const Calibration& calibration, std::string name) {
  const TipMotion& motion = result.trajectory.motion;
  const BasePath& path = result.base.path;
  const std::size_t n = motion.size();
  if (n < 2 || path.size() != n) throw Error(name + ": the stroke has no base path");
  const std::vector<double>& axial_N = motion.axial_force_N.empty() ? motion.force_N : motion.axial_force_N;
  const bool three_axes = !motion.force_world_N.empty();
  if (motion.force_N.size() != n || !any_finite(motion.force_N)) throw Error(name + ": the stroke has no force");
  StrokeSignals out;
  out.name = std::move(name);
  const Vector3d axis_in_marker = calibration.force_axis_in_marker();
  const std::vector<Vector3d> travel = tangents(path);
  std::size_t readings = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d& normal = path.n_world[i];
    const Vector3d axis = motion.q_world_marker[i] * axis_in_marker;
    out.t_s.push_back(static_cast<double>(motion.t_ns[i] - motion.t_ns.front()) * kNanosecond_s);
    out.s_m.push_back(path.s_m[i]);
    out.height_m.push_back(normal.dot(motion.p_world_tip_m[i] - path.p_world_m[i]));
    out.travel_mps.push_back(travel[i].dot(motion.v_world_tip_mps[i]));
    out.climb_mps.push_back(normal.dot(motion.v_world_tip_mps[i]));
    out.accel_mps2.push_back(normal.dot(motion.a_world_tip_mps2[i]));
    out.force_N.push_back(three_axes ? motion.force_N[i] : axial_N[i]);
    out.reads_normal.push_back(three_axes ? 1.0 : axis.dot(normal));
    out.reads_tangential.push_back(three_axes ? 0.0 : axis.dot(travel[i]));
    if (three_axes) out.tangential_N.push_back(-travel[i].dot(motion.force_world_N[i]));
    readings += std::isfinite(out.force_N.back()) ? 1U : 0U;
  }
  const double span_s = out.t_s.back();
  out.rate_Hz = static_cast<double>(n - 1) / span_s;
  out.force_rate_Hz = static_cast<double>(readings) / span_s;
  out.normal_N = bridge_gaps(out.t_s, motion.force_N);
  out.speed_mps = moving_average(result.base.speed_mps, static_cast<std::size_t>(0.5 * kSpeedWindow_s * out.rate_Hz));

  std::vector<double> speeds;
  const auto touches = [&](std::size_t i) { return result.base.contact.empty() || result.base.contact[i] != 0; };
  const double fastest = *std::max_element(out.speed_mps.begin(), out.speed_mps.end());
  for (std::size_t i = 0; i < n; ++i) {
    if (touches(i) && out.speed_mps[i] > 0.2 * fastest) speeds.push_back(out.speed_mps[i]);
  }
  if (speeds.empty()) throw Error(out.name + ": the stroke has no contact in motion");
  out.usual_mps = median(speeds);
  for (std::size_t i = 0; i < n; ++i)
    out.usable.push_back(touches(i) && out.speed_mps[i] >= kMoving * out.usual_mps ? 1 : 0);
  return out;
}

}  // namespace asperity
