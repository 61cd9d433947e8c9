#include "motion_curves.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/units.h"
#include "pose_at.h"
#include "running_integral.h"

namespace asperity {

namespace {

constexpr std::size_t kMostGridPoints = std::size_t{1} << 24;  // a day

MotionCurve empty_curve(const std::vector<std::int64_t>& t_ns) {
  const auto points = static_cast<std::size_t>((t_ns.back() - t_ns.front()) / kCurveStep_ns) + 1;
  return {t_ns.front(), std::vector<double>(std::min(points, kMostGridPoints), std::nan(""))};
}

std::int64_t time_at(const MotionCurve& curve, std::size_t i) {
  return curve.start_ns + static_cast<std::int64_t>(i) * kCurveStep_ns;
}

}  // namespace

MotionCurve angular_speed(const PoseStream& pose, std::int64_t half_ns) {
  MotionCurve out = empty_curve(pose.t_ns);
  PoseAt before(pose), after(pose);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    const std::int64_t t_ns = time_at(out, i);
    const auto a = before.interpolate(t_ns - half_ns), b = after.interpolate(t_ns + half_ns);
    if (a && b) out.value[i] = rotation_between_rad(*a, *b) / (2e-9 * static_cast<double>(half_ns));
  }
  return out;
}

MotionCurve angular_speed(const VectorStream& rate, std::int64_t half_ns) {
  MotionCurve out = empty_curve(rate.t_ns);
  const RunningIntegral turned(rate.t_ns, rate.value);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    const std::int64_t t_ns = time_at(out, i);
    if (const auto angle = turned.between(t_ns - half_ns, t_ns + half_ns))
      out.value[i] = angle->norm() / (2e-9 * static_cast<double>(half_ns));
  }
  return out;
}

MotionCurve specific_force_size(const PoseStream& pose, std::int64_t half_ns, const Eigen::Vector3d& up) {
  MotionCurve out = empty_curve(pose.t_ns);
  const std::int64_t h_ns = 2 * half_ns;
  const double h_s = 1e-9 * static_cast<double>(h_ns);
  PoseAt before(pose), here(pose), after(pose);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    const std::int64_t t_ns = time_at(out, i);
    const auto a = before.interpolate(t_ns - h_ns), b = here.interpolate(t_ns), c = after.interpolate(t_ns + h_ns);
    if (!a || !b || !c) continue;
    const Eigen::Vector3d difference = a->translation_m - 2.0 * b->translation_m + c->translation_m;
    out.value[i] = (difference / (h_s * h_s) + kStandardGravity_mps2 * up).norm();
  }
  return out;
}

MotionCurve specific_force_size(const VectorStream& specific_force, std::int64_t half_ns) {
  MotionCurve out = empty_curve(specific_force.t_ns);
  const RunningIntegral sum(specific_force.t_ns, specific_force.value);
  const std::int64_t steps = std::max<std::int64_t>(1, half_ns / kCurveStep_ns);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    // The mean over h of means over h, by the trapezoidal rule.
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    bool whole = true;
    for (std::int64_t k = -steps; k <= steps && whole; ++k) {
      const std::int64_t t_ns = time_at(out, i) + k * half_ns / steps;
      const auto part = sum.between(t_ns - half_ns, t_ns + half_ns);
      whole = part.has_value();
      if (part) mean += (std::abs(k) == steps ? 0.5 : 1.0) * *part;
    }
    if (whole) out.value[i] = mean.norm() / (2e-9 * static_cast<double>(half_ns) * 2.0 * static_cast<double>(steps));
  }
  return out;
}

}  // namespace asperity
