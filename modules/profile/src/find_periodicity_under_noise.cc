#include "asperity/profile/find_periodicity_under_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/apply_wiener_filter.h"
#include "asperity/signal/statistics.h"
#include "draw_noise.h"
#include "period_depths.h"

namespace asperity {

namespace {

constexpr double kNoiseBridge_m = 2e-3;  // gaps across which noise is taken out
constexpr double kByChance = 0.01;       // of finding a line in noise
constexpr double kSurely = 1.96;
constexpr int kHarmonicsSeen = 8;
constexpr double kPitchReach = 0.02;     // relative: as far as a first pitch may be off
constexpr double kMultipleReach = 0.06;  // the same of a multiple in noise
constexpr std::size_t kDepthDraws = 16;
constexpr std::uint64_t kDepthSeed = 20'260'102;

// The standard error of the median over the periods, as far as unlike periods show it.
double depth_scatter_m(std::span<const double> height_m, double period) {
  const std::vector<double> depths = period_depths(height_m, period);
  if (depths.empty()) return kNan;
  return std::sqrt(0.5 * std::numbers::pi / static_cast<double>(depths.size())) * kSigmaPerMad *
         median_absolute_deviation(depths);
}

double usual_depth_m(std::span<const double> height_m, double period) {
  const std::vector<double> depths = period_depths(height_m, period);
  return depths.empty() ? kNan : median(depths);
}

// The density of `psd` at a frequency, by straight lines; its last value beyond.
double noise_density_at(const std::vector<double>& frequency, const std::vector<double>& psd, double at) {
  const auto above = std::upper_bound(frequency.begin(), frequency.end(), at);
  if (above == frequency.begin()) return psd.front();
  if (above == frequency.end()) return psd.back();
  const auto b = static_cast<std::size_t>(above - frequency.begin());
  const double share = (at - frequency[b - 1]) / (frequency[b] - frequency[b - 1]);
  return psd[b - 1] + share * (psd[b] - psd[b - 1]);
}

// The periodogram of a profile over the density of its noise. Of noise alone it exceeds q with the probability exp(−q).
class LineSearch {
 public:
  LineSearch(std::span<const double> height_m, double spacing_m, const std::vector<double>& frequency,
             const std::vector<double>& psd, double shortest_m)
      : height_m_(height_m), spacing_m_(spacing_m), frequency_(frequency), psd_(psd) {
    for (const double h : height_m) points_ += std::isfinite(h) ? 1.0 : 0.0;
    // A search looks at as many frequencies as the profile is shortest pitches long.
    clear_ = std::log(std::max(2.0, length_m() / shortest_m) / kByChance);
  }

  // Whether the pattern's harmonic stands out, looked for as far as the pitch may be off.
  bool has_line(double pitch_m, int harmonic) const {
    const double middle = harmonic * spacing_m_ / pitch_m;
    const double step = 0.5 * spacing_m_ / length_m();
    const int reach = static_cast<int>(std::ceil(kPitchReach * middle / step));
    for (int k = -reach; k <= reach; ++k) {
      const double f = middle + k * step;
      if (f <= 0.0 || f > 0.5) continue;
      if (ratio(f) > clear_ + std::log(2.0 * reach + 1.0)) return true;
    }
    return false;
  }

 private:
  double length_m() const { return spacing_m_ * static_cast<double>(height_m_.size()); }

  double ratio(double cycles_a_point) const {
    const std::complex<double> step = std::polar(1.0, -2.0 * std::numbers::pi * cycles_a_point);
    std::complex<double> sum = 0.0, phasor = 1.0;
    for (const double h : height_m_) {
      if (std::isfinite(h)) sum += h * phasor;
      phasor *= step;
    }
    const double periodogram_m2_mm = 2e3 * spacing_m_ * std::norm(sum) / points_;
    return periodogram_m2_mm / noise_density_at(frequency_, psd_, 1e-3 * cycles_a_point / spacing_m_);
  }

  std::span<const double> height_m_;
  double spacing_m_ = 0.0;
  const std::vector<double>&frequency_, &psd_;
  double points_ = 0.0, clear_ = 0.0;
};

// By how much the pitch is too long: 2 to 8 if none but every so many of its harmonics are lines; 1 if it is right,
// 0 if there is no line at all.
int find_multiple(const LineSearch& search, double pitch_m) {
  std::array<bool, kHarmonicsSeen + 1> line{};
  bool any = false;
  for (int h = 1; h <= kHarmonicsSeen; ++h) any |= line[static_cast<std::size_t>(h)] = search.has_line(pitch_m, h);
  if (!any) return 0;
  for (int multiple = kHarmonicsSeen; multiple > 1; --multiple) {
    bool only = true, has = false;
    for (int h = 1; h <= kHarmonicsSeen; ++h) {
      (h % multiple == 0 ? has : only) =
          h % multiple == 0 ? has || line[static_cast<std::size_t>(h)] : only && !line[static_cast<std::size_t>(h)];
    }
    if (only && has) return multiple;
  }
  return 1;
}

}  // namespace

Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config) {
  if (!(noise.added_rms_m > 0.0)) return find_periodicity(height_m, spacing_m, config);
  std::vector<double> psd = noise.added_psd_m2_mm;
  for (std::size_t i = 0; i < psd.size(); ++i) psd[i] += noise.misplaced_psd_m2_mm[i];
  const std::vector<double> quiet_m =
      apply_wiener_filter(height_m, spacing_m, noise.frequency_cycles_per_mm, psd, kNoiseBridge_m).texture_m;
  Periodicity out = find_periodicity(quiet_m, spacing_m, config);
  if (!std::isfinite(out.pitch_m)) return out;
  const double most = 1.0 + kSurely * 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  // Misplaced heights blur a line; they make none where there is none.
  std::vector<double> most_psd = noise.added_psd_m2_mm;
  for (double& density : most_psd) density *= most;
  const LineSearch search(height_m, spacing_m, noise.frequency_cycles_per_mm, most_psd, config.min_pitch_m);
  const int multiple = find_multiple(search, out.pitch_m);
  if (multiple > 1) {
    PeriodicityConfig near = config;
    near.min_pitch_m = std::max(config.min_pitch_m, (1.0 - kMultipleReach) * out.pitch_m / multiple);
    near.max_pitch_m = (1.0 + kMultipleReach) * out.pitch_m / multiple;
    // A pitch below the shortest is not looked for.
    const Periodicity shorter =
        near.max_pitch_m > near.min_pitch_m ? find_periodicity(quiet_m, spacing_m, near) : Periodicity{};
    if (std::isfinite(shorter.pitch_m)) out = shorter;
  }
  if (multiple == 0) {
    out.periodic = false;
    out.pitch_stderr_m = out.depth_stderr_m = kNan;
    return out;
  }
  out.depth_m = usual_depth_m(height_m, out.pitch_m / spacing_m);
  out.pitch_stderr_m = std::hypot(out.pitch_stderr_m, noise.along_sigma * out.pitch_m);
  if (!std::isfinite(out.depth_m)) return out;

  const double period = out.pitch_m / spacing_m;
  Random random(kDepthSeed);
  std::vector<double> heavier(height_m.size());
  std::array<std::vector<double>, 2> squares;
  std::vector<double> once;
  for (std::size_t j = 0; j < kDepthDraws; ++j) {
    const std::vector<double> more =
        draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, height_m.size(), 1e3 * spacing_m, random);
    for (std::size_t power = 1; power <= 2; ++power) {
      const double factor = std::sqrt(static_cast<double>(power));
      for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + factor * more[i];
      const double depth_m = usual_depth_m(heavier, period);
      if (!std::isfinite(depth_m)) return out;
      squares[power - 1].push_back(depth_m * depth_m);
      if (power == 1) once.push_back(depth_m);
    }
  }
  const double before_m = out.depth_m;
  const double none = before_m * before_m, with = mean(squares[0]), twice = mean(squares[1]);
  const double line = 2.0 * none - with, parabola = 3.0 * none - 3.0 * with + twice;
  if (!(line > 0.0) || !(parabola > 0.0)) {
    out.depth_m = out.depth_stderr_m = kNan;
    return out;
  }
  out.depth_m = std::sqrt(parabola);
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  // Of what noise adds to extremes the extrapolation finds about half: its curve is steepest where it cannot look.
  const double doubt_m = 0.5 * (out.depth_m - before_m);
  // The draws know the noise that was found; what else there is, restored peaks and impacts, shows between the periods.
  const double spread_m = std::max(standard_deviation(once), depth_scatter_m(height_m, period));
  out.depth_stderr_m = std::hypot(std::hypot(spread_m, doubt_m),
                                  std::hypot(relative * (out.depth_m - before_m), noise.scale_sigma * out.depth_m));
  return out;
}

}  // namespace asperity
