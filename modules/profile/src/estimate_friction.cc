#include "asperity/profile/estimate_friction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"
#include "friction_laws.h"
#include "rubbing.h"

namespace asperity {

namespace {

constexpr double kTwoSided95 = 1.959963984540054;
constexpr std::array<double, 9> kDelays_s{0.0, 0.3e-3, 0.5e-3, 0.8e-3, 1.2e-3, 1.6e-3, 2.5e-3, 4e-3, 8e-3};

std::vector<double> finite_of(const std::vector<double>& x) {
  std::vector<double> out;
  std::copy_if(x.begin(), x.end(), std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

// Windows of sliding that follow one another without a break in contact, their medians and means.
struct Windows {
  std::vector<double> median_rad, mean_rad, speed_mps, force_N;
};

Windows cut_windows(const Rubbing& r, const std::vector<double>& angle_rad, const FrictionConfig& config) {
  Windows out;
  const std::size_t n = r.t_s.size();
  for (std::size_t begin = 0; begin < n;) {
    std::vector<double> angles;
    double speed_mps = 0.0, force_N = 0.0;
    std::size_t end = begin;
    while (end < n && r.t_s[end] - r.t_s[begin] < config.window_s) {
      if (std::isfinite(angle_rad[end])) {
        angles.push_back(angle_rad[end]);
        speed_mps += r.speed_mps[end];
        force_N += r.force_N[end];
      }
      ++end;
    }
    const auto count = static_cast<double>(angles.size());
    if (angles.size() >= 10 && count >= 0.5 * static_cast<double>(end - begin)) {
      out.median_rad.push_back(median(angles));
      out.mean_rad.push_back(mean(angles));
      out.speed_mps.push_back(speed_mps / count);
      out.force_N.push_back(force_N / count);
    }
    begin = end;
  }
  return out;
}

// What the tip has to overcome at rest, over what it feels while it slides. A tip that slides has overcome it: no ratio
// is below 1.
void find_static_ratio(FrictionEstimate& out) {
  if (std::isfinite(out.breakaway)) {
    out.static_ratio = std::max(1.0, out.breakaway / out.coefficient);
    out.static_ratio_stderr = out.breakaway / out.coefficient *
                              std::hypot(out.breakaway_stderr / out.breakaway, out.standard_error / out.coefficient);
  } else if (out.stribeck) {
    out.static_ratio = std::max(1.0, out.stribeck->at_rest / out.coefficient);
  }
}

}  // namespace

FrictionEstimate estimate_friction(const TipMotion& motion, const BasePath& path, std::span<const char> contact,
                                   const FrictionConfig& config) {
  const std::size_t n = motion.size();
  FrictionEstimate out;
  if (motion.force_world_N.empty()) {
    out.verdict = "not measured: friction needs a force sensor of three axes";
    return out;
  }
  if (motion.force_world_N.size() != n || motion.v_world_tip_mps.size() != n || path.n_world.size() != n ||
      contact.size() != n) {
    throw Error("friction: motion, force, base path and contact differ in size (" + std::to_string(n) + " samples)");
  }
  if (n == 0) {
    out.verdict = "not measured: the recording has no motion";
    return out;
  }
  const Rubbing rubbing = look_at_samples(motion, path, contact, config);
  find_sticks(rubbing, config, out);

  std::vector<double> angle_rad;
  for (const double delay_s : kDelays_s) {
    std::vector<double> tried = friction_angles(rubbing, delay_s, config);
    const std::vector<double> known = finite_of(tried);
    if (known.empty()) break;
    const double spread = percentile(known, 75.0) - percentile(known, 25.0);
    if (std::isfinite(out.spread_rad) && !(spread < out.spread_rad)) continue;
    out.spread_rad = spread;
    out.sensor_delay_s = delay_s;
    angle_rad = std::move(tried);
  }
  const Windows windows = angle_rad.empty() ? Windows{} : cut_windows(rubbing, angle_rad, config);
  const std::size_t count = windows.median_rad.size();
  if (count < static_cast<std::size_t>(config.min_windows)) {
    out.verdict = fmt::format("not determined: the tip slid in contact for {} windows of {:.2g} s, {} are needed",
                              count, config.window_s, config.min_windows);
    return out;
  }
  for (std::size_t i = 0; i < count; ++i)
    out.windows.push_back({std::tan(windows.median_rad[i]), windows.speed_mps[i], windows.force_N[i]});
  const double angle = median(windows.median_rad);
  out.coefficient = std::tan(angle);
  out.speed_mps = median(windows.speed_mps);
  out.force_N = median(windows.force_N);

  std::vector<double> residual;
  for (const double a : windows.median_rad) residual.push_back(a - angle);
  constexpr double kMedianLoss = 1.5707963267948966;  // of a median's variance over a mean's, Gaussian
  const double scatter_rad = std::sqrt(kMedianLoss * variance(residual) / independent_count(residual));
  const double edges_rad = 2.0 * std::abs(mean(windows.mean_rad) - mean(windows.median_rad));
  const double offset = config.offset_sigma_N / out.force_N;
  const double per_rad = 1.0 + out.coefficient * out.coefficient;
  out.standard_error = std::hypot(std::hypot(per_rad * scatter_rad, per_rad * edges_rad),
                                  std::hypot(per_rad * config.alignment_sigma_rad, offset));
  out.low = std::max(0.0, out.coefficient - kTwoSided95 * out.standard_error);
  out.high = out.coefficient + kTwoSided95 * out.standard_error;
  fit_slopes(out);
  fit_stribeck(out);

  const double allowed = std::max(config.max_stderr, 0.25 * out.coefficient);
  if (!(out.standard_error <= allowed)) {
    out.verdict = fmt::format(
        "not determined: the standard error is {:.2g}, more than {:.2g}; {}", out.standard_error, allowed,
        edges_rad * per_rad > 0.5 * out.standard_error ? "the tip runs against edges: slide over a smoother part"
                                                       : "slide longer, and with more force");
  } else if (out.high <= 0.0) {
    out.verdict = "not determined: the force along the surface is not against the motion; check the sensor's axes";
  } else {
    out.determined = true;
    out.verdict = "determined";
    find_static_ratio(out);
  }
  return out;
}

}  // namespace asperity
