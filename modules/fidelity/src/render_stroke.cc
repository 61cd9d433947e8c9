#include "asperity/fidelity/render_stroke.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/signal/butterworth.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

namespace {

constexpr double kLongestStep_s = 50e-6, kMostSteps = 1e8;

// The stroke's hand on an even grid of time.
struct EvenHand {
  double step_s = 0.0;
  std::vector<double> t_s, s_m, slow_N, reads_normal, reads_tangential;
};

EvenHand even_hand(const StrokeSignals& stroke, double step_s, double low_cycles_per_mm) {
  EvenHand out;
  const double count = std::floor(stroke.t_s.back() / step_s);
  if (!(count <= kMostSteps)) throw Error("render stroke: too many steps for this stiffness");
  out.step_s = step_s;
  const auto n = static_cast<std::size_t>(count) + 1;
  const auto even = [&](const std::vector<double>& x) { return resample_uniform(stroke.t_s, x, 0.0, step_s, n); };
  out.t_s = even(stroke.t_s);
  out.s_m = even(stroke.s_m);
  out.reads_normal = even(stroke.reads_normal);
  out.reads_tangential = even(stroke.reads_tangential);
  // Slow against the probe's samples: filtered there, for a corner far below the rate loses digits.
  constexpr double kSlowStep_s = 1e-3;
  const auto slow_count = static_cast<std::size_t>(std::floor(stroke.t_s.back() / kSlowStep_s)) + 1;
  const std::vector<double> force_N = resample_uniform(stroke.t_s, stroke.normal_N, 0.0, kSlowStep_s, slow_count);
  const double corner_Hz = std::min(1e3 * low_cycles_per_mm * stroke.usual_mps, 0.4 / kSlowStep_s);
  const std::vector<double> slow_N = zero_phase_lowpass(force_N, corner_Hz, 1.0 / kSlowStep_s);
  for (std::size_t i = 0; i < n; ++i)
    out.slow_N.push_back(
        std::max(0.0, value_at(slow_N, std::min(out.t_s[i] / kSlowStep_s, static_cast<double>(slow_count - 1)))));
  return out;
}

// The relief without gaps and mean, and its slope, at any place: a natural cubic spline, whose second derivative, which
// the tip feels as acceleration, has no steps.
class Relief {
 public:
  Relief(std::span<const double> relief_m, const PathGrid& grid)
      : grid_(grid), height_m_(relief_m.size(), 0.0), bend_(relief_m.size(), 0.0) {
    double sum = 0.0, known = 0.0;
    for (const double height : relief_m) {
      if (!std::isfinite(height)) continue;
      sum += height;
      known += 1.0;
    }
    for (std::size_t i = 0; i < relief_m.size(); ++i)
      if (std::isfinite(relief_m[i])) height_m_[i] = relief_m[i] - sum / known;
    // b[i−1] + 4 b[i] + b[i+1] = 6 (h[i−1] − 2 h[i] + h[i+1]), b the second derivative times the spacing squared, 0 at
    // both ends: Thomas' elimination.
    std::vector<double> upper(height_m_.size(), 0.0);
    for (std::size_t i = 1; i + 1 < height_m_.size(); ++i) {
      const double pivot = 4.0 - upper[i - 1];
      upper[i] = 1.0 / pivot;
      bend_[i] = (6.0 * (height_m_[i - 1] - 2.0 * height_m_[i] + height_m_[i + 1]) - bend_[i - 1]) / pivot;
    }
    for (std::size_t i = height_m_.size(); i-- > 1;) {
      if (i + 1 < height_m_.size()) bend_[i] -= upper[i] * bend_[i + 1];
    }
    bend_.front() = 0.0;
  }

  struct Value {
    double height_m, slope;
  };
  Value at(double s_m) const {
    const double last = static_cast<double>(height_m_.size() - 1);
    const double place = std::clamp(s_m / grid_.spacing_m - static_cast<double>(grid_.first), 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(place, last - 1.0));
    const double u = place - static_cast<double>(i), w = 1.0 - u;
    const double a = height_m_[i], b = height_m_[i + 1], p = bend_[i] / 6.0, q = bend_[i + 1] / 6.0;
    return {w * a + u * b + (w * w * w - w) * p + (u * u * u - u) * q,
            (b - a - (3.0 * w * w - 1.0) * p + (3.0 * u * u - 1.0) * q) / grid_.spacing_m};
  }

 private:
  PathGrid grid_;
  std::vector<double> height_m_, bend_;
};

// Causal, settled on the first value.
std::vector<double> low_passed(std::vector<double> x, double bandwidth_Hz, double rate_Hz) {
  if (!(bandwidth_Hz > 0.0) || bandwidth_Hz >= 0.45 * rate_Hz || x.empty()) return x;
  for (const Biquad& b : butterworth_lowpass(2, bandwidth_Hz, rate_Hz)) {
    double z2 = (b.b2 - b.a2) * x.front(), z1 = (b.b1 - b.a1) * x.front() + z2;
    for (double& value : x) {
      const double y = b.b0 * value + z1;
      z1 = b.b1 * value - b.a1 * y + z2;
      z2 = b.b2 * value - b.a2 * y;
      value = y;
    }
  }
  return x;
}

}  // namespace

RenderedStroke render_stroke(const StrokeSignals& stroke, const PathGrid& grid, std::span<const double> relief_m,
                             const RenderedContact& contact, const HandImpedance& hand, const VirtualProbeConfig& probe,
                             double low_cycles_per_mm) {
  const double k = contact.stiffness_N_per_m, m = hand.mass_kg;
  if (!(k > 0.0) || !(m > 0.0)) throw Error("render stroke: stiffness or mass is not positive");
  if (relief_m.size() != grid.count || grid.count < 2) throw Error("render stroke: the relief is not on the grid");
  const double c = 2.0 * probe.contact_damping_ratio * std::sqrt(k * m);
  const EvenHand even = even_hand(stroke, std::min(kLongestStep_s, 0.1 * std::sqrt(m / k)), low_cycles_per_mm);
  const Relief relief(relief_m, grid);
  const std::size_t n = even.t_s.size();
  std::vector<double> accel_mps2(n), force_N(n), normal_N(n), tangential_N(n);
  double h_m = relief.at(even.s_m.front()).height_m - even.slow_N.front() / k, rate_mps = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = std::min(i + 1, n - 1), before = i > 0 ? i - 1 : 0;
    const double speed_mps = (even.s_m[next] - even.s_m[before]) /
                             (even.step_s * static_cast<double>(std::max<std::size_t>(next - before, 1)));
    const Relief::Value z = relief.at(even.s_m[i]);
    const double depth_m = z.height_m - h_m;
    const double F = depth_m > 0.0 ? std::max(0.0, k * depth_m + c * (z.slope * speed_mps - rate_mps)) : 0.0;
    const double T = F * (contact.friction + z.slope);
    const double hand_N =
        even.slow_N[i] + hand.stiffness_N_per_m * (h_m + even.slow_N[i] / k) + hand.damping_N_s_per_m * rate_mps;
    accel_mps2[i] = (F - hand_N) / m;
    normal_N[i] = F;
    tangential_N[i] = T;
    force_N[i] = F * even.reads_normal[i] - T * even.reads_tangential[i];
    rate_mps += accel_mps2[i] * even.step_s;
    h_m += rate_mps * even.step_s;
  }
  accel_mps2 = low_passed(std::move(accel_mps2), probe.accel_bandwidth_Hz, 1.0 / even.step_s);
  RenderedStroke out;
  const auto at_samples = [&](const std::vector<double>& x) {
    std::vector<double> y(stroke.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = value_at(x, std::min(stroke.t_s[i] / even.step_s, static_cast<double>(n - 1)));
    return y;
  };
  out.accel_mps2 = at_samples(accel_mps2);
  out.force_N = at_samples(through_pole(even.t_s, force_N, probe.force_bandwidth_Hz));
  out.normal_N = at_samples(through_pole(even.t_s, normal_N, probe.force_bandwidth_Hz));
  out.tangential_N = at_samples(through_pole(even.t_s, tangential_N, probe.force_bandwidth_Hz));
  return out;
}

}  // namespace asperity
