#include "true_figures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "asperity/base/nan.h"

namespace bench {

namespace {

using asperity::kNan;

double range_m(std::span<const double> z) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double h : z) {
    if (!std::isfinite(h)) continue;
    low = std::min(low, h);
    high = std::max(high, h);
  }
  return high - low;
}

double harmonic_power(std::span<const double> x, double cycles_per_sample) {
  double power = 0.0;
  for (int h = 1; h <= 4; ++h) {
    const double turn = 2.0 * std::numbers::pi * h * cycles_per_sample;
    std::complex<double> sum = 0.0, phasor = 1.0;
    const std::complex<double> step = std::polar(1.0, -turn);
    for (const double value : x) {
      if (std::isfinite(value)) sum += value * phasor;
      phasor *= step;
    }
    power += std::norm(sum);
  }
  return power;
}

}  // namespace

double position_error_over_sigma(const asperity::Recording& recording, const asperity::TipMotion& motion) {
  if (!recording.truth || motion.cov_world_tip_m2.empty() || motion.size() < 2) return kNan;
  const asperity::Truth& truth = *recording.truth;
  double sum = 0.0, count = 0.0;
  std::size_t b = 1;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth.t_ns[i] < motion.t_ns.front() || truth.t_ns[i] > motion.t_ns.back()) continue;
    while (b + 1 < motion.size() && motion.t_ns[b] < truth.t_ns[i]) ++b;
    const double share = static_cast<double>(truth.t_ns[i] - motion.t_ns[b - 1]) /
                         static_cast<double>(motion.t_ns[b] - motion.t_ns[b - 1]);
    const Eigen::Vector3d at_m =
        motion.p_world_tip_m[b - 1] + share * (motion.p_world_tip_m[b] - motion.p_world_tip_m[b - 1]);
    const Eigen::Vector3d error_m = at_m - truth.p_world_tip_m[i];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      sum += error_m[axis] * error_m[axis] / motion.cov_world_tip_m2[b](axis, axis);
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNan;
}

double error_over_sigma(std::span<const double> error_m, std::span<const double> sigma_m) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < std::min(error_m.size(), sigma_m.size()); ++i) {
    if (!std::isfinite(error_m[i]) || !(sigma_m[i] > 0.0)) continue;
    sum += error_m[i] * error_m[i] / (sigma_m[i] * sigma_m[i]);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNan;
}

PlainRoughness measure_plain_roughness(std::span<const double> texture_m) {
  constexpr std::size_t kSections = 5;
  PlainRoughness out;
  double n = 0.0, mean = 0.0;
  for (const double h : texture_m) {
    if (!std::isfinite(h)) continue;
    mean += h;
    n += 1.0;
  }
  if (n < 2.0) return {kNan, kNan, kNan, kNan, kNan, kNan};
  mean /= n;
  double second = 0.0, third = 0.0, fourth = 0.0;
  for (const double h : texture_m) {
    if (!std::isfinite(h)) continue;
    const double z = h - mean;
    out.Ra_m += std::abs(z) / n;
    second += z * z / n;
    third += z * z * z / n;
    fourth += z * z * z * z / n;
  }
  out.Rq_m = std::sqrt(second);
  out.Rsk = third / (second * out.Rq_m);
  out.Rku = fourth / (second * second);
  out.Rt_m = range_m(texture_m);
  std::size_t used = 0;
  for (std::size_t k = 0; k < kSections; ++k) {
    const std::size_t from = k * texture_m.size() / kSections, to = (k + 1) * texture_m.size() / kSections;
    const auto section = texture_m.subspan(from, to - from);
    const auto present = std::count_if(section.begin(), section.end(), [](double h) { return std::isfinite(h); });
    if (static_cast<double>(present) < 0.5 * static_cast<double>(section.size()) || present < 2) continue;
    out.Rz_m += range_m(section);
    ++used;
  }
  out.Rz_m = used > 0 ? out.Rz_m / static_cast<double>(used) : kNan;
  return out;
}

double find_true_pitch_m(std::span<const double> texture_m, double spacing_m, double pitch_m) {
  constexpr double kReach = 0.08;
  const double length_m = static_cast<double>(texture_m.size()) * spacing_m;
  if (!(pitch_m > 0.0) || length_m < 3.0 * pitch_m) return kNan;
  const double middle = spacing_m / pitch_m;
  // In steps of a tenth of the resolution, then finer about the best.
  double step = 0.1 / static_cast<double>(texture_m.size());
  double best = middle, most = harmonic_power(texture_m, middle);
  const auto search = [&](double centre, int count) {
    for (int k = -count; k <= count; ++k) {
      const double f = centre + k * step;
      const double power = harmonic_power(texture_m, f);
      if (power > most) {
        most = power;
        best = f;
      }
    }
  };
  search(middle, std::max(3, static_cast<int>(kReach * middle / step)));
  for (int round = 0; round < 3; ++round) {
    step *= 0.2;
    search(best, 5);
  }
  return spacing_m / best;
}

double measure_depth_m(std::span<const double> height_m, double spacing_m, double pitch_m) {
  if (!(pitch_m > 2.0 * spacing_m)) return kNan;
  std::vector<double> depths;
  const double period = pitch_m / spacing_m;
  for (double from = 0.0; from + period <= static_cast<double>(height_m.size()); from += period) {
    const auto first = static_cast<std::size_t>(from), last = static_cast<std::size_t>(from + period);
    const auto part = height_m.subspan(first, last - first);
    const auto present = std::count_if(part.begin(), part.end(), [](double h) { return std::isfinite(h); });
    if (static_cast<double>(present) >= 0.7 * static_cast<double>(part.size())) depths.push_back(range_m(part));
  }
  if (depths.size() < 3) return kNan;
  std::sort(depths.begin(), depths.end());
  const std::size_t middle = depths.size() / 2;
  return depths.size() % 2 == 1 ? depths[middle] : 0.5 * (depths[middle - 1] + depths[middle]);
}

}  // namespace bench
