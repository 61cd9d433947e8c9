#include "asperity/profile/find_periodicity_under_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/profile/apply_wiener_filter.h"
#include "bent_path.h"
#include "find_lattice.h"
#include "find_rib_directions.h"
#include "follow_pattern.h"
#include "line_search.h"
#include "measure_depth_under_noise.h"

namespace asperity {

namespace {

constexpr double kNoiseBridge_m = 2e-3;  // gaps across which noise is taken out
constexpr double kSurely = 1.96;
constexpr int kHarmonicsSeen = 8;
constexpr std::size_t kFewestPeriods = 3;
constexpr double kAlongShare = 1.0 / 2.0, kRibsShare = 1.0 / 3.0, kLatticeShare = 1.0 / 6.0;
constexpr double kMultipleReach = 0.06;  // the same of a multiple in noise

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
  // Of two waves the second may stand out further than the first, of which the noise has more.
  if (2.0 * out.pitch_m <= longest_m && search.is_second_of_pair(out.pitch_m)) {
    const Periodicity whole = follow_pattern(quiet_m, spacing_m, 2.0 * out.pitch_m, config);
    if (std::isfinite(whole.pitch_m)) {
      out = whole;
      out.periodic = out.periods >= kFewestPeriods;
    }
  }
  out.pitch_stderr_m = std::hypot(out.pitch_stderr_m, noise.along_sigma * out.pitch_m);
  measure_depth_under_noise(height_m, spacing_m, noise, out);
  return out;
}

// A lattice's pitch along the path is the mean distance of the rows of its first wave.
Periodicity follow_lattice(const BentPath& path, const Lattice& lattice, std::span<const double> height_m,
                           double spacing_m, const TextureNoise& noise, const PeriodicityConfig& config) {
  const double tangent = lattice.wave_per_m.y() / lattice.wave_per_m.x();
  const double across_m = 1.0 / lattice.wave_per_m.norm(), pitch_m = across_m / path.across_over_along(tangent);
  Periodicity out = follow_pattern(path.straightened(height_m, tangent), spacing_m, pitch_m, config);
  out.periodic = out.periods >= kFewestPeriods;
  out.pitch_m = pitch_m;
  const double relative = std::hypot(lattice.relative_sigma, noise.along_sigma);
  out.across_pitch_m = across_m;
  out.across_pitch_stderr_m = relative * across_m;
  out.pitch_stderr_m = std::hypot(relative, path.spread_of_period(tangent)) * pitch_m;
  measure_depth_under_noise(height_m, spacing_m, noise, out);
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

  // Each of the three searches has a share of the chance.
  const Periodicity along = find_along(height_m, spacing_m, noise, config, {kAlongShare, 0.0});
  if (along.periodic) return along;
  const RibDirections ribs = find_rib_directions(path, height_m, spacing_m, noise, config);
  for (const RibDirection& rib : ribs.best) {
    Periodicity out = find_along(path.straightened(height_m, rib.tangent), spacing_m, noise, config,
                                 {kRibsShare, ribs.range * path.bend_rms_m()});
    if (!out.periodic) continue;
    out.rib_tangent = rib.tangent;
    out.across_pitch_m = path.across_over_along(rib.tangent) * out.pitch_m;
    out.across_pitch_stderr_m = out.across_pitch_m * std::hypot(out.pitch_stderr_m / out.pitch_m,
                                                                rib.sigma * path.change_of_across(rib.tangent));
    out.pitch_stderr_m = std::hypot(out.pitch_stderr_m, path.spread_of_period(rib.tangent) * out.pitch_m);
    return out;
  }
  const std::optional<Lattice> lattice = find_lattice(path, height_m, spacing_m, noise, highest_noise(noise), config,
                                                      kLatticeShare * LineSearch::kByChance);
  if (!lattice) return along;
  const Periodicity followed = follow_lattice(path, *lattice, height_m, spacing_m, noise, config);
  return followed.periodic ? followed : along;
}

}  // namespace asperity
