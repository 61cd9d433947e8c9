#include "asperity/profile/make_profile_thesis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/units.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/profile/thesis_steps.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {
namespace {

double uniform_period_s(const TipMotion& motion) {
  if (motion.size() < 2) throw Error(fmt::format("the motion has {} samples; a profile needs two", motion.size()));
  const std::int64_t period_ns = motion.t_ns[1] - motion.t_ns[0];
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (motion.t_ns[i] - motion.t_ns[i - 1] != period_ns) {
      throw Error(fmt::format("motion sample {}: {} ns after the one before, not {} ns as the first", i,
                              motion.t_ns[i] - motion.t_ns[i - 1], period_ns));
    }
  }
  return static_cast<double>(period_ns) * kNanosecond_s;
}

}  // namespace

// §5.2: gaps are bridged for the filter and marked again after it.
std::vector<double> extract_texture_thesis(const std::vector<double>& height_m, const ThesisProfileConfig& config) {
  if (config.cutoff_cycles_per_mm == 0.0) return height_m;
  const double samples_per_mm = 1e-3 / config.spacing_m;
  std::vector<double> texture_m =
      zero_phase_highpass(bridge_gaps(height_m), config.cutoff_cycles_per_mm, samples_per_mm, config.order);
  for (std::size_t i = 0; i < texture_m.size(); ++i) {
    if (std::isnan(height_m[i])) texture_m[i] = kNan;
  }
  return texture_m;
}

ThesisProfileResult make_profile_thesis(const TipMotion& motion, const BasePath& base,
                                        const ThesisProfileConfig& config) {
  if (base.n_world.size() != motion.size() || base.p_world_m.size() != motion.size()) {
    throw Error(fmt::format("{} motion samples but {} normals", motion.size(), base.n_world.size()));
  }
  const double period_s = uniform_period_s(motion);

  // §4.3: the acceleration along the surface normal.
  std::vector<double> a_normal_mps2 = blend_acceleration(motion.a_world_tip_mps2, base.n_world);

  // §4.4: scaled according to the force.
  if (config.scale_by_force) {
    const auto half_width = static_cast<std::size_t>(std::lround(0.5 * config.force_window_s / period_s));
    const std::vector<double> scale = force_scale(motion.force_N, half_width);
    for (std::size_t i = 0; i < scale.size(); ++i) a_normal_mps2[i] *= scale[i];
  }

  // §5.1: height by Verlet integration over time, distance by summing the segments of the filtered
  // path, its motion along the normal removed (erratum 23).
  std::vector<double> height_m = integrate_verlet(a_normal_mps2, period_s);
  const std::vector<double> s_m = path_length_m(base.p_world_m);

  // §4.4, B.1: stick and slip removed after the integration (erratum 25).
  const std::vector<char> moving = mark_stick_slip(motion.v_world_tip_mps, base.n_world, config.min_speed_mps);
  const auto first = std::find(moving.begin(), moving.end(), 1);
  const auto last = std::find(moving.rbegin(), moving.rend(), 1);
  if (first == moving.end()) {
    throw Error(fmt::format("no sample moves at {} m/s or more along the surface", config.min_speed_mps));
  }
  std::vector<double> speed_mps(motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    speed_mps[i] = motion.v_world_tip_mps[i].norm();
    if (!moving[i]) height_m[i] = kNan;
  }

  ThesisProfileResult result;
  result.samples = motion.size();
  result.slow_samples = static_cast<std::size_t>(std::count(moving.begin(), moving.end(), 0));
  const double begin_m = s_m[static_cast<std::size_t>(first - moving.begin())];
  const double end_m = s_m[motion.size() - 1 - static_cast<std::size_t>(last - moving.rbegin())];
  result.length_m = end_m - begin_m;

  // §5.2: heights spaced equidistantly, then the high-pass.
  Profile& profile = result.profile;
  profile.spacing_m = config.spacing_m;
  const std::size_t count = count_points(result.length_m, config.spacing_m);
  profile.s_m.resize(count);
  for (std::size_t i = 0; i < count; ++i) profile.s_m[i] = begin_m + static_cast<double>(i) * config.spacing_m;
  profile.height_m = resample_uniform(s_m, height_m, begin_m, config.spacing_m, count);
  profile.texture_m = extract_texture_thesis(profile.height_m, config);
  profile.sigma_m.assign(count, kNan);
  profile.force_N = resample_uniform(s_m, motion.force_N, begin_m, config.spacing_m, count);
  profile.speed_mps = resample_uniform(s_m, speed_mps, begin_m, config.spacing_m, count);
  return result;
}

}  // namespace asperity
