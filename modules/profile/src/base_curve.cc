#include "base_curve.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

namespace {

constexpr double kSpacing_m = 0.5e-3;

void smooth_points(std::vector<Eigen::Vector3d>& v, double cutoff_per_m) {
  std::vector<double> x(v.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < v.size(); ++i) x[i] = v[i][axis];
    const std::vector<double> y = zero_phase_lowpass(x, cutoff_per_m, 1.0 / kSpacing_m);
    for (std::size_t i = 0; i < v.size(); ++i) v[i][axis] = y[i];
  }
}

// The curve at the fractional index x.
CurvePoint point_at(const BaseCurve& curve, double x) {
  const auto last = static_cast<double>(curve.p_m.size() - 2);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, last));
  const double f = x - static_cast<double>(i);
  return {(1.0 - f) * curve.p_m[i] + f * curve.p_m[i + 1],
          ((1.0 - f) * curve.normal[i] + f * curve.normal[i + 1]).normalized(),
          (1.0 - f) * curve.s_m[i] + f * curve.s_m[i + 1]};
}

}  // namespace

BaseCurve make_base_curve(const PathEvidence& evidence, double cutoff_cycles_per_mm) {
  const std::size_t count = count_points(evidence.travelled_m.back(), kSpacing_m);
  if (count < 8) throw Error("base path: the path in contact is too short for a base curve");
  BaseCurve out;
  out.spacing_m = kSpacing_m;
  out.p_m.resize(count);
  out.normal.resize(count);
  std::size_t c = 0;
  while (evidence.weight[c] == 0.0) ++c;
  for (std::size_t k = 0; k < count; ++k) {
    const double s = kSpacing_m * static_cast<double>(k);
    while (c + 1 < evidence.path.size() && evidence.travelled_m[c + 1] <= s) ++c;
    while (c + 1 < evidence.path.size() && evidence.weight[c] == 0.0) ++c;
    const std::size_t next = std::min(c + 1, evidence.path.size() - 1);
    const double f = std::clamp((s - evidence.travelled_m[c]) / std::max(evidence.weight[c], 1e-12), 0.0, 1.0);
    out.p_m[k] = (1.0 - f) * evidence.path.p_m[c] + f * evidence.path.p_m[next];
    out.normal[k] = evidence.probe_axis[c];
  }
  const double cutoff_per_m = 1e3 * cutoff_cycles_per_mm;
  smooth_points(out.p_m, cutoff_per_m);
  smooth_points(out.normal, cutoff_per_m);
  out.tangent.resize(count);
  out.s_m.assign(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = std::min(k + 1, count - 1);
    out.tangent[k] = (out.p_m[b] - out.p_m[a]).normalized();
    Eigen::Vector3d n = out.normal[k] - out.normal[k].dot(out.tangent[k]) * out.tangent[k];
    if (n.norm() < 1e-3) n = out.tangent[k].unitOrthogonal();
    out.normal[k] = n.normalized();
    if (k > 0) out.s_m[k] = out.s_m[k - 1] + (out.p_m[k] - out.p_m[k - 1]).norm();
  }
  return out;
}

std::vector<CurvePoint> project_on_curve(const BaseCurve& curve, const PathEvidence& evidence,
                                         std::span<const double> t_s, std::span<const Eigen::Vector3d> p_m) {
  std::vector<CurvePoint> out;
  out.reserve(t_s.size());
  const auto last = static_cast<double>(curve.p_m.size() - 1);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const std::size_t c = index_at(evidence.path, t_s[i]);
    const double fraction = (t_s[i] - evidence.path.time_s(c)) / evidence.path.step_s;
    double x = (evidence.travelled_m[c] + fraction * evidence.weight[c]) / curve.spacing_m;
    for (int step = 0; step < 4; ++step) {
      const auto k = static_cast<std::size_t>(std::clamp(x, 0.0, last));
      // Beyond its ends the curve goes on straight; a step is limited so that a point far off cannot jump to another
      // bend.
      x += std::clamp(curve.tangent[k].dot(p_m[i] - point_at(curve, x).p_m) / curve.spacing_m, -10.0, 10.0);
    }
    out.push_back(point_at(curve, x));
  }
  return out;
}

}  // namespace asperity
