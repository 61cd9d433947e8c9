#include "asperity/profile/find_periodicity_under_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/profile/apply_wiener_filter.h"
#include "asperity/signal/statistics.h"
#include "bent_path.h"
#include "draw_noise.h"
#include "find_rib_directions.h"
#include "follow_pattern.h"
#include "line_search.h"
#include "period_depths.h"
#include "root_of_power.h"

namespace asperity {

namespace {

constexpr double kNoiseBridge_m = 2e-3;  // gaps across which noise is taken out
constexpr double kSurely = 1.96;
constexpr int kHarmonicsSeen = 8;
constexpr std::size_t kFewestPeriods = 3;
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

double root_mean_square(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v * v;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNan;
}

// By how much the pitch is too long: 2 to 8 if none but every so many of its harmonics are lines; 1 if it is right,
// 0 if there is no line at all.
int find_multiple(const LineSearch& search, double pitch_m) {
  std::array<bool, kHarmonicsSeen + 1> line{};
  bool any = false;
  // h is at most kHarmonicsSeen, the array one longer.
  // cppcheck-suppress containerOutOfBounds
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

double highest_noise(const TextureNoise& noise) {
  return 1.0 + kSurely * 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
}

Periodicity find_along(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                       const PeriodicityConfig& config, const LineSearch::Hypotheses& hypotheses) {
  std::vector<double> psd = noise.added_psd_m2_mm;
  for (std::size_t i = 0; i < psd.size(); ++i) psd[i] += noise.misplaced_psd_m2_mm[i];
  const std::vector<double> quiet_m =
      apply_wiener_filter(height_m, spacing_m, noise.frequency_cycles_per_mm, psd, kNoiseBridge_m).texture_m;
  Periodicity out = find_repetition(quiet_m, spacing_m, config);
  if (!std::isfinite(out.pitch_m)) return out;
  // Misplaced heights blur a line; they make none where there is none.
  const double longest_m = std::min(config.max_pitch_m, spacing_m * static_cast<double>(height_m.size()) / 3.0);
  const LineSearch search(height_m, spacing_m, noise.frequency_cycles_per_mm, noise.added_psd_m2_mm,
                          highest_noise(noise), config.min_pitch_m, longest_m, hypotheses);
  // At its line and not by the correlation, which follows what is strongest, as the hand's tremor on a smooth pattern.
  const auto follow_line = [&](double shortest_m, double most_m) {
    const double line_m = search.find_line_m(shortest_m, most_m);
    const Periodicity found = line_m > 0.0 ? follow_pattern(quiet_m, spacing_m, line_m, config) : Periodicity{};
    if (!std::isfinite(found.pitch_m)) return false;
    out = found;
    out.periodic = out.periods >= kFewestPeriods;  // the line is the evidence, however weak its correlation is in noise
    return true;
  };
  const auto find_near = [&](double pitch_m) {
    PeriodicityConfig near = config;
    near.min_pitch_m = std::max(config.min_pitch_m, (1.0 - kMultipleReach) * pitch_m);
    near.max_pitch_m = (1.0 + kMultipleReach) * pitch_m;
    if (!(near.max_pitch_m > near.min_pitch_m)) return;  // a pitch below the shortest is not looked for
    if (follow_line(near.min_pitch_m, near.max_pitch_m)) return;
    const Periodicity found = find_repetition(quiet_m, spacing_m, near);
    if (std::isfinite(found.pitch_m)) out = found;
  };
  int multiple = find_multiple(search, out.pitch_m);
  if (multiple > 1 && out.pitch_m / multiple < config.min_pitch_m) {
    multiple = 0;  // the pattern is shorter than what is looked for, and a multiple of its pitch is no pitch
  } else if (multiple > 1) {
    find_near(out.pitch_m / multiple);
  }
  // Near the correlation's pitch a harmonic may stand out of its neighbours by chance.
  if (multiple == 0 || !search.has_pattern(out.pitch_m)) multiple = follow_line(config.min_pitch_m, longest_m) ? 1 : 0;
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
  for (std::size_t j = 0; j < kDepthDraws; ++j) {
    const std::vector<double> more =
        draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, height_m.size(), 1e3 * spacing_m, random);
    for (std::size_t power = 1; power <= 2; ++power) {
      const double factor = std::sqrt(static_cast<double>(power));
      for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + factor * more[i];
      const double depth_m = usual_depth_m(heavier, period);
      if (!std::isfinite(depth_m)) return out;
      squares[power - 1].push_back(depth_m * depth_m);
    }
  }
  const double before_m = out.depth_m;
  const double none = before_m * before_m, with = mean(squares[0]), twice = mean(squares[1]);
  const double parabola = 3.0 * none - 3.0 * with + twice;
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  // Of what noise adds to extremes the extrapolation finds about half: its curve is steepest where it cannot look.
  const double doubt_m2 = 0.5 * (parabola - none);
  // The draws know the noise that was found; what else there is, restored peaks and impacts, shows between the periods.
  const double scatter_m = depth_scatter_m(height_m, period);
  const double spread_m2 = std::max(standard_deviation(squares[0]), 2.0 * before_m * scatter_m);
  const double height =
      std::hypot(noise.scale_sigma, noise.contact_rms_m / std::numbers::sqrt3 / root_mean_square(height_m));
  const Root depth = root_of_power(parabola, std::hypot(std::hypot(spread_m2, doubt_m2),
                                                        std::hypot(relative * (parabola - none), 2.0 * height * none)));
  out.depth_m = depth.value;
  out.depth_stderr_m = depth.standard_error;
  return out;
}

}  // namespace

Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config) {
  return find_periodicity_under_noise(height_m, spacing_m, noise, config, {});
}

Periodicity find_periodicity_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const PeriodicityConfig& config, std::span<const Eigen::Vector2d> unrolled_m) {
  if (!unrolled_m.empty() && unrolled_m.size() != height_m.size())
    throw Error("periodicity: " + std::to_string(unrolled_m.size()) + " points of " + std::to_string(height_m.size()) +
                " heights");
  if (!(noise.added_rms_m > 0.0)) return find_periodicity(height_m, spacing_m, config);
  const BentPath path(unrolled_m, spacing_m);
  if (!path.bends()) return find_along(height_m, spacing_m, noise, config, {});

  // Each of the two searches has half of the chance.
  constexpr double kHalf = 0.5;
  const Periodicity along = find_along(height_m, spacing_m, noise, config, {kHalf, 0.0});
  if (along.periodic) return along;
  const RibDirections ribs = find_rib_directions(path, height_m, spacing_m, noise, config);
  for (const RibDirection& rib : ribs.best) {
    Periodicity out = find_along(path.straightened(height_m, rib.tangent), spacing_m, noise, config,
                                 {kHalf, ribs.range * path.bend_rms_m()});
    if (!out.periodic) continue;
    out.across_pitch_m = path.across_over_along(rib.tangent) * out.pitch_m;
    out.across_pitch_stderr_m = out.across_pitch_m * std::hypot(out.pitch_stderr_m / out.pitch_m,
                                                                rib.sigma * path.change_of_across(rib.tangent));
    out.pitch_stderr_m = std::hypot(out.pitch_stderr_m, path.spread_of_period(rib.tangent) * out.pitch_m);
    return out;
  }
  return along;
}

}  // namespace asperity
