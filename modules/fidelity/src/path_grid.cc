#include "asperity/fidelity/path_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/profile/resample_over_path.h"

namespace asperity {

namespace {

constexpr double kLargestHole_m = 0.6e-3;  // as a profile's

}  // namespace

PathGrid grid_of(const Profile& profile) {
  if (profile.size() < 2) throw Error("the stroke has no profile");
  return {static_cast<std::ptrdiff_t>(std::llround(profile.s_m.front() / profile.spacing_m)), profile.size(),
          profile.spacing_m};
}

std::vector<double> over_path(const StrokeSignals& stroke, std::span<const double> signal, const PathGrid& grid) {
  if (signal.size() != stroke.size()) throw Error("over path: signal and stroke differ in size");
  const PathKnots knots = gather_knots(stroke.s_m, std::span(&signal, 1), stroke.usable, 0.25 * grid.spacing_m);
  return resample_smooth(knots, grid.first, grid.count, grid.spacing_m, kLargestHole_m);
}

std::vector<double> through_pole(std::span<const double> t_s, std::span<const double> x, double bandwidth_Hz) {
  std::vector<double> out(x.begin(), x.end());
  if (!(bandwidth_Hz > 0.0)) return out;
  const double corner_radps = 2.0 * std::numbers::pi * bandwidth_Hz;
  for (std::size_t i = 1; i < out.size(); ++i) {
    // Straight lines between the values, exactly.
    const double step = corner_radps * (t_s[i] - t_s[i - 1]);
    const double keep = std::exp(-step), ramp = step > 1e-6 ? (1.0 - keep) / step : 1.0;
    out[i] = keep * out[i - 1] + (ramp - keep) * x[i - 1] + (1.0 - ramp) * x[i];
  }
  return out;
}

double value_at(std::span<const double> x, double place) {
  if (!(place >= 0.0) || !(place <= static_cast<double>(x.size() - 1))) return kNan;
  const auto i = std::min(static_cast<std::size_t>(place), x.size() - 2);
  const double u = place - static_cast<double>(i);
  if (u == 0.0) return x[i];
  const double b = x[i], c = x[i + 1];
  const double a = i > 0 ? x[i - 1] : kNan, d = i + 2 < x.size() ? x[i + 2] : kNan;
  if (!std::isfinite(a) || !std::isfinite(d)) return b + u * (c - b);
  // Catmull and Rom's cubic.
  const double m0 = 0.5 * (c - a), m1 = 0.5 * (d - b), rise = c - b;
  return b + u * (m0 + u * (3.0 * rise - 2.0 * m0 - m1 + u * (m0 + m1 - 2.0 * rise)));
}

}  // namespace asperity
