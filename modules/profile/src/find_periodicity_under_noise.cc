#include "asperity/profile/find_periodicity_under_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"
#include "draw_noise.h"
#include "period_depths.h"

namespace asperity {

namespace {

constexpr std::size_t kDepthDraws = 16;
constexpr std::uint64_t kDepthSeed = 20'260'102;

double usual_depth_m(std::span<const double> height_m, double period) {
  const std::vector<double> depths = period_depths(height_m, period);
  return depths.empty() ? kNan : median(depths);
}

}  // namespace

Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config) {
  Periodicity out = find_periodicity(height_m, spacing_m, config);
  if (!(noise.added_rms_m > 0.0) || !std::isfinite(out.pitch_m)) return out;
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
  out.depth_stderr_m = std::hypot(std::hypot(standard_deviation(once), doubt_m),
                                  std::hypot(relative * (out.depth_m - before_m), noise.scale_sigma * out.depth_m));
  return out;
}

}  // namespace asperity
