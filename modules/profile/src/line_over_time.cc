#include "asperity/profile/line_over_time.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr int kHarmonics = 8;
constexpr double kStep = 0.25;         // of an independent frequency
constexpr double kSlowest_mps = 1e-4;  // slower, the time that a cell took is not known

double power_at(std::span<const double> x, std::span<const double> at, double frequency) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::polar(x[i], -2.0 * std::numbers::pi * frequency * at[i]);
  return std::norm(sum);
}

double highest_between(std::span<const double> x, std::span<const double> at, double low, double high) {
  const double step = kStep / (at.back() - at.front());
  double out = 0.0;
  for (double f = low; f <= high + 0.5 * step; f += step) out = std::max(out, power_at(x, at, f));
  return out;
}

}  // namespace

double line_over_time(const Profile& profile, std::span<const double> height_m, double pitch_m) {
  if (!(pitch_m > 0.0) || profile.speed_mps.size() != profile.size() || height_m.size() != profile.size()) return kNan;
  std::vector<double> x, s_m, t_s, speed_mps;
  double t = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double v = profile.speed_mps[i];
    if (!std::isfinite(v)) continue;  // the tip was not there
    t += profile.spacing_m / std::max(v, kSlowest_mps);
    if (!std::isfinite(height_m[i])) continue;
    x.push_back(height_m[i]);
    s_m.push_back(profile.s_m[i]);
    t_s.push_back(t);
    speed_mps.push_back(v);
    sum += height_m[i];
  }
  if (x.size() < 16 || !(t_s.back() > t_s.front()) || !(s_m.back() > s_m.front())) return kNan;
  for (double& h : x) h -= sum / static_cast<double>(x.size());

  const double length_m = s_m.back() - s_m.front();
  double line = 0.0;
  int harmonic = 1;
  for (int h = 1; h <= kHarmonics && pitch_m / h > 2.0 * profile.spacing_m; ++h) {
    const double power = highest_between(x, s_m, h / pitch_m - 0.5 / length_m, h / pitch_m + 0.5 / length_m);
    if (power > line) {
      line = power;
      harmonic = h;
    }
  }
  if (!(line > 0.0)) return kNan;
  const double per_m = harmonic / pitch_m;
  return highest_between(x, t_s, per_m * percentile(speed_mps, 5.0), per_m * percentile(speed_mps, 95.0)) / line;
}

}  // namespace asperity
