#include "process_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/pipeline/reference.h"
#include "asperity/pipeline/scan_evidence.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/find_contact.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "asperity/profile/find_time_lines.h"
#include "asperity/profile/measure_roughness_under_noise.h"
#include "asperity/profile/measure_surface_spectrum.h"
#include "asperity/profile/pattern_element_width.h"
#include "asperity/profile/unroll_path.h"
#include "measure_on_surface.h"
#include "repeated_lines.h"

namespace asperity::stage {

namespace {

// The outcome of a step that may not succeed.
template <class T, class Step>
Outcome<T> attempt_step(const char* kind, const char* what, Step step) {
  Outcome<T> out;
  try {
    out.value = step();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    out.problems.push_back({kind, std::string("no ") + what + ": " + error.what(), 1});
  }
  return out;
}

// The force sensor's axis, from the tip to the hand; none where the calibration gives it no direction.
std::optional<Eigen::Vector3d> force_axis(const Calibration& calibration) {
  if (!calibration.force.axis_in_marker && calibration.tip_in_marker_m.isZero(0.0)) return std::nullopt;
  return calibration.force_axis_in_marker();
}

SpeedStatistics measure_speed(const Profile& profile) {
  SpeedStatistics out;
  double time_s = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double speed = profile.speed_mps[i];
    if (!std::isfinite(speed) || speed <= 0.0 || !std::isfinite(profile.height_m[i])) continue;
    out.lowest_mps = count == 0 ? speed : std::min(out.lowest_mps, speed);
    out.highest_mps = count == 0 ? speed : std::max(out.highest_mps, speed);
    time_s += profile.spacing_m / speed;
    ++count;
  }
  // Way over time, not the mean over points, which a slow stretch would not lower enough.
  if (count > 0) out.mean_mps = static_cast<double>(count) * profile.spacing_m / time_s;
  return out;
}

// What a regression on the force would be of: nothing, where the sensor was at the end of its range.
template <class Estimate>
std::optional<Outcome<Estimate>> without_force(const ForceLimit& limit) {
  if (!limit.is_limited()) return std::nullopt;
  Outcome<Estimate> out;
  out.value.emplace().verdict = fmt::format(
      "not determined: {:.2g} % of the force's readings are at the end of its range", 100.0 * limit.share());
  return out;
}

}  // namespace

Outcome<TrajectoryResult> find_trajectory(const Recording& recording, const ProcessConfig& config,
                                          const ProcessMethod& method, const Observer& observer) {
  Outcome<TrajectoryResult> out;
  TrajectoryResult& trajectory = out.value.emplace(method.estimate_trajectory(recording, config, observer));
  if (!trajectory.object) refer_trajectory(recording, config.reference, config.object, trajectory);
  out.problems = trajectory.problems;

  // Until the normal is known, a sensor of three axes is read along the probe's.
  TipMotion& motion = trajectory.motion;
  const std::optional<Eigen::Vector3d> axis = force_axis(recording.calibration);
  if (method.uses_normal_force && axis) {
    for (std::size_t i = 0; i < motion.force_world_N.size(); ++i)
      motion.force_N[i] = (motion.q_world_marker[i] * *axis).dot(motion.force_world_N[i]);
  }

  // Without a force sensor a motion need not be a scan.
  if (!has_force(recording)) {
    std::vector<double>& force_N = trajectory.motion.force_N;
    std::fill(force_N.begin(), force_N.end(), std::numeric_limits<double>::quiet_NaN());
    motion.force_world_N.clear();
    out.problems.push_back({"no_force", "the force never changes: all of the path counts as scanned", 1});
  }
  return out;
}

const Recording& in_frame(const Recording& recording, ProcessStages& s) {
  if (!s.trajectory.value->object) return recording;
  if (!s.on_object) s.on_object = recording_on_object(recording, *s.trajectory.value);
  return *s.on_object;
}

Outcome<BasePathResult> find_base_path(const Recording& recording, const ProcessConfig& config,
                                       const ProcessMethod& method, ProcessStages& before) {
  TipMotion& motion = before.trajectory.value->motion;
  before.force_limit = find_force_limit(recording);
  const auto find = [&] {
    return method.find_base_path ? method.find_base_path(recording, config, motion)
                                 : asperity::find_base_path(motion, recording.calibration.tip_in_marker_m, config.base);
  };
  Outcome<BasePathResult> out = attempt_step<BasePathResult>("no_profile", "profile", [&] {
    if (!method.uses_normal_force) return find();
    if (motion.axial_force_N.empty()) motion.axial_force_N = motion.force_N;
    motion.force_N = motion.axial_force_N;
    BasePathResult base = find();
    const std::optional<Eigen::Vector3d> axis = force_axis(recording.calibration);
    const auto along_normal = [&] {
      base.force = find_normal_force(motion, motion.axial_force_N, base.path, base.contact, axis,
                                     base.normal_sigma_deg * std::numbers::pi / 180.0);
      motion.force_N = std::move(base.force.force_N);
    };
    along_normal();
    // Where the contact is another by the force along the normal, so is the path.
    if (base.force.source != ForceSource::kNone && find_contact(motion, config.base.contact) != base.contact) {
      base = find();
      along_normal();
    }
    measure_on_surface(motion, config.base, base, before.force_limit.is_limited());
    return base;
  });
  if (out.value) out.problems = out.value->problems;
  return out;
}

Outcome<MeasuredProfile> find_profile(const Recording& recording, const ProcessConfig& config,
                                      const ProcessMethod& method, const ProcessStages& before) {
  if (!before.base.value) return {};
  return attempt_step<MeasuredProfile>("no_profile", "profile", [&] {
    MeasuredProfile out;
    const TrajectoryResult& trajectory = *before.trajectory.value;
    const BasePathResult& base = *before.base.value;
    out.profile = method.make_profile(config, trajectory.motion, base);
    out.speed = measure_speed(out.profile);
    const HeightErrors errors =
        method.height_errors ? method.height_errors(recording, config, trajectory, base) : HeightErrors{};
    TextureNoiseEstimate noise = estimate_texture_noise(out.profile, errors, method.high_pass_cycles_per_mm(config),
                                                        {config.profile.bridge_m, config.profile.max_stop_s});
    out.noise = std::move(noise.noise);
    out.profile.texture_sigma_m = std::move(noise.texture_sigma_m);
    if (!noise.height_sigma_m.empty()) out.profile.sigma_m = std::move(noise.height_sigma_m);
    out.noise.time_lines = find_time_lines(out.profile, out.profile.texture_m, out.noise.place_sigma_m,
                                           unroll_path(base.path, out.profile.s_m));
    add_time_lines(out.profile, out.noise);
    out.measured_texture_m = out.profile.texture_m;
    if (config.profile.merge_passes) merge_recorded_lines(base, out);
    finish_profile(recording, config, out);
    return out;
  });
}

Outcome<RoughnessResult> measure_roughness(const ProcessConfig& config, const ProcessStages& before) {
  if (!before.profile.value) return {};
  const Profile& profile = before.profile.value->profile;
  const TextureNoise& noise = before.profile.value->noise;
  return attempt_step<RoughnessResult>("no_roughness", "roughness", [&] {
    RoughnessResult out = measure_roughness_under_noise(before.profile.value->measured_texture_m, profile.spacing_m,
                                                        noise, config.roughness);
    // Where noise hides the single elements, those of the pattern.
    if (!std::isfinite(out.RSm_m) && before.periodicity.value) {
      std::vector<Eigen::Vector2d> unrolled_m;
      if (before.base.value) unrolled_m = unroll_path(before.base.value->path, profile.s_m);
      const ElementWidth width = pattern_element_width(profile.texture_m, profile.spacing_m, *before.periodicity.value,
                                                       noise, config.roughness, unrolled_m);
      out.RSm_m = width.mean_m;
      out.standard_error.RSm_m = width.stderr_m;
    }
    return out;
  });
}

Outcome<Periodicity> find_periodicity(const ProcessConfig& config, const ProcessStages& before) {
  if (!before.profile.value) return {};
  const MeasuredProfile& measured = *before.profile.value;
  // A merged profile is of many paths and has none of its own.
  std::vector<Eigen::Vector2d> unrolled_m;
  if (before.base.value) unrolled_m = unroll_path(before.base.value->path, measured.profile.s_m);
  return {find_periodicity_under_noise(measured.measured_texture_m, measured.profile.spacing_m, measured.noise,
                                       config.periodicity, unrolled_m),
          {}};
}

Outcome<SurfaceSpectrum> measure_spectrum(const ProcessStages& before) {
  if (!before.profile.value) return {};
  const MeasuredProfile& measured = *before.profile.value;
  if (measured.profile.size() < 2) return {};
  return {measure_surface_spectrum(measured.measured_texture_m, measured.profile.spacing_m, measured.noise), {}};
}

Outcome<Compliance> estimate_compliance(const Recording& recording, const ProcessConfig& config,
                                        const ProcessMethod& method, const ProcessStages& before) {
  if (!before.profile.value) return {};
  if (auto limited = without_force<Compliance>(before.force_limit)) return *std::move(limited);
  return {method.estimate_compliance(recording, config, before.trajectory.value->motion, *before.base.value), {}};
}

Outcome<StiffnessEstimate> estimate_stiffness(const ProcessConfig& config, const ProcessStages& before) {
  if (!before.profile.value) return {};
  if (auto limited = without_force<StiffnessEstimate>(before.force_limit)) return *std::move(limited);
  const BasePathResult& base = *before.base.value;
  return {asperity::estimate_stiffness(before.trajectory.value->motion, base.path, base.contact, config.stiffness,
                                       base.shape == PathShape::kCurve ? config.base.curve_cutoff_cycles_per_mm : 0.0),
          {}};
}

Outcome<FrictionEstimate> estimate_friction(const ProcessConfig& config, const ProcessStages& before) {
  if (!before.profile.value) return {};
  if (!before.trajectory.value->motion.force_world_N.empty()) {
    if (auto limited = without_force<FrictionEstimate>(before.force_limit)) return *std::move(limited);
  }
  const BasePathResult& base = *before.base.value;
  return {asperity::estimate_friction(before.trajectory.value->motion, base.path, base.contact, config.friction), {}};
}

Outcome<FourierFit> fit_texture(const ProcessConfig& config, const ProcessStages& before) {
  if (!before.profile.value) return {};
  const Profile& profile = before.profile.value->profile;
  Outcome<FourierFit> out = attempt_step<FourierFit>(
      "no_texture", "texture", [&] { return fit_fourier1d(profile.texture_m, profile.spacing_m, config.texture); });
  if (out.value) out.problems = out.value->problems;
  return out;
}

Outcome<Accuracy> compare_with_truth(const Recording& recording, const ProcessConfig& config,
                                     const ProcessMethod& method, const ProcessStages& before) {
  Outcome<Accuracy> out;
  if (!recording.truth) return out;
  const Profile profile = before.profile.value ? before.profile.value->profile : Profile{};
  try {
    TextureOf texture_of;
    if (method.comparable_texture) {
      texture_of = [&](const std::vector<double>& height_m) { return method.comparable_texture(config, height_m); };
    }
    out.value = measure_accuracy(recording, before.trajectory.value->motion, profile, config.comparison, texture_of);
  } catch (const Error& error) {
    out.problems.push_back({"no_accuracy", std::string("not compared with the truth: ") + error.what(), 1});
  }
  return out;
}

}  // namespace asperity::stage
