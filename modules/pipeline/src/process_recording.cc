#include "asperity/pipeline/process_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "asperity/base/error.h"
#include "asperity/base/version.h"
#include "asperity/pipeline/config_json.h"
#include "asperity/pipeline/find_doubts.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/trajectory/reject_outliers.h"
#include "asperity/trajectory/sample_at_probe.h"

namespace asperity {

namespace {

void append(Problems& to, const Problems& from) { to.insert(to.end(), from.begin(), from.end()); }

void distrust(ProcessResult& result, const std::string& why) {
  result.trustworthy = false;
  result.verdict += (result.verdict.empty() ? "" : "; ") + why;
}

TrajectoryResult estimate_trajectory(const Recording& recording, const ProcessConfig& config,
                                     const Observer& observer) {
  if (config.method == Method::kFused) return estimate_trajectory_fused(recording, config.fused, observer);
  return estimate_trajectory_thesis(recording, config.thesis.trajectory);
}

// The compliance wants accelerations at the probe's own rate, which the seed's motion has thinned.
Compliance estimate_compliance_by(Method method, const Recording& recording, const TipMotion& motion,
                                  const BasePath& base, const ProcessConfig& config) {
  if (method == Method::kFused) return estimate_compliance(motion, motion.t_ns, base.n_world, config.compliance);
  const Outliers outliers = reject_outliers(recording.probe, recording.calibration, config.thesis.trajectory.outliers);
  const TipMotion samples =
      sample_at_probe(recording.probe, outliers, recording.calibration, recording.info.gravity_world_mps2, motion);
  return estimate_compliance(samples, motion.t_ns, base.n_world, config.compliance);
}

Profile make_profile_by(Method method, const TipMotion& motion, const BasePathResult& base,
                        const ProcessConfig& config) {
  if (method == Method::kFused) return make_profile(motion, base.path, base.contact, config.profile);
  return make_profile_thesis(motion, base.path, config.thesis.profile).profile;
}

Coverage measure_coverage(const Profile& profile) {
  Coverage out;
  const auto present = [&](std::size_t i) { return std::isfinite(profile.height_m[i]); };
  std::size_t first = 0;
  std::size_t last = profile.size();
  while (first < last && !present(first)) ++first;
  while (last > first && !present(last - 1)) --last;
  std::size_t covered = 0;
  for (std::size_t i = first; i < last; ++i) {
    covered += present(i) ? 1 : 0;
    out.gaps += !present(i) && present(i - 1) ? 1 : 0;
  }
  if (last == first) return out;
  out.length_m = static_cast<double>(last - 1 - first) * profile.spacing_m;
  out.covered = static_cast<double>(covered) / static_cast<double>(last - first);
  return out;
}

SpeedFigures measure_speed(const Profile& profile) {
  SpeedFigures out;
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

// A force sensor that never changes is none: whether the tip touched is then not known.
bool has_force(const ProbeStream& probe) {
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const double counts : probe.force_counts) {
    if (!std::isfinite(counts)) continue;
    if (std::isfinite(first) && counts != first) return true;
    first = counts;
  }
  return false;
}

// Runs a step that a usable recording may not allow, such as roughness of too short a profile: it then
// stays absent and the steps before it stand. Returns whether it succeeded.
template <class Step>
bool attempt(ProcessResult& result, const char* kind, const char* what, Step step) {
  try {
    step();
    return true;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    result.problems.push_back({kind, std::string("no ") + what + ": " + error.what(), 1});
    distrust(result, std::string("no ") + what);
    return false;
  }
}

Texture make_texture(const ProcessResult& result, const Recording& recording, const ProcessConfig& config) {
  Texture texture;
  texture.name = recording.info.object;
  texture.model = result.fit->texture;
  texture.lift_m = result.fit->lift_m;
  if (std::isfinite(result.compliance.k_c)) texture.compliance_kc = result.compliance.k_c;
  if (result.stiffness.measured) texture.stiffness_N_per_m = 1e3 * result.stiffness.stiffness_N_per_mm;
  if (result.roughness) {
    const RoughnessResult& r = *result.roughness;
    for (const auto& [key, value] : {std::pair{"Ra_m", r.Ra_m},
                                     {"Rq_m", r.Rq_m},
                                     {"Rz_m", r.Rz_m},
                                     {"Rt_m", r.Rt_m},
                                     {"Rsk", r.Rsk},
                                     {"Rku", r.Rku},
                                     {"RSm_m", r.RSm_m}}) {
      if (std::isfinite(value)) texture.roughness[key] = value;
    }
  }
  const bool fused = config.method == Method::kFused;
  const double low = fused ? config.profile.cutoff_cycles_per_mm : config.thesis.profile.cutoff_cycles_per_mm;
  const double fit_high = static_cast<double>(result.fit->texture.a_m.size()) / result.fit->texture.length_mm;
  const double nyquist = 0.5 / (result.profile.spacing_m * 1e3);
  texture.band_cycles_per_mm = {low, std::min(fit_high, nyquist)};
  texture.source.config_json = result.config_json;
  texture.source.version = kVersion;
  return texture;
}

void judge_coverage(ProcessResult& result, const ProcessConfig& config) {
  if (result.coverage.covered < config.min_coverage) {
    const int percent = static_cast<int>(std::lround(100.0 * result.coverage.covered));
    distrust(result, "only " + std::to_string(percent) + " % of the profile has heights");
  }
}

void find_profile(const ProcessConfig& config, const FindBase& find_base, ProcessResult& result,
                  const Observer& observer) {
  const TipMotion& motion = result.trajectory.motion;
  // The path without the fine motion, and its normals (seed §1.4, §6.2; errata 23 and 24).
  observer.update("base path", 0.7);
  result.base = find_base(motion);
  append(result.problems, result.base.problems);

  // The height along it and its texture (seed §5.1, §5.2).
  observer.update("profile", 0.8);
  result.profile = make_profile_by(config.method, motion, result.base, config);
  result.coverage = measure_coverage(result.profile);
  result.speed = measure_speed(result.profile);
}

void measure_surface(const Recording& recording, const ProcessConfig& config, ProcessResult& result,
                     const Observer& observer) {
  const TipMotion& motion = result.trajectory.motion;
  observer.update("roughness", 0.85);
  attempt(result, "no_roughness", "roughness", [&] {
    result.roughness = measure_roughness(result.profile.texture_m, result.profile.spacing_m, config.roughness);
  });

  result.periodicity = find_periodicity(result.profile.texture_m, result.profile.spacing_m, config.periodicity);

  // How it yields (seed §5.3, erratum 15).
  observer.update("compliance", 0.9);
  result.compliance = estimate_compliance_by(config.method, recording, motion, result.base.path, config);
  result.stiffness = estimate_stiffness(motion, result.base.path, result.base.contact, config.stiffness);

  // What a hand is to feel of it (seed §6.5, erratum 18).
  observer.update("texture", 0.95);
  attempt(result, "no_texture", "texture", [&] {
    result.fit = fit_fourier1d(result.profile.texture_m, result.profile.spacing_m, config.texture);
    append(result.problems, result.fit->problems);
    result.texture = make_texture(result, recording, config);
  });
}

// A truth that does not fit says nothing against the measurement.
void compare_with_truth(const Recording& recording, const ProcessConfig& config, ProcessResult& result) {
  try {
    result.accuracy = measure_accuracy(recording, result.trajectory.motion, result.profile, config.comparison);
  } catch (const Error& error) {
    result.problems.push_back({"no_accuracy", std::string("not compared with the truth: ") + error.what(), 1});
  }
}

}  // namespace

ProcessResult estimate_motion(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  ProcessResult result;
  ProcessConfig resolved = config;
  result.config_json = config_json(list_fields("", resolved));
  append(result.problems, recording.problems);

  // Where the tip was (seed §4.1 to §4.3).
  observer.update("trajectory", 0.0);
  result.trajectory = estimate_trajectory(recording, config, observer);
  TipMotion& motion = result.trajectory.motion;
  append(result.problems, result.trajectory.problems);
  if (!result.trajectory.trustworthy) distrust(result, result.trajectory.verdict);
  for (const std::string& doubt : find_doubts(recording, result.trajectory)) distrust(result, doubt);

  // Without a force sensor a motion need not be a scan.
  if (!has_force(recording.probe)) {
    std::fill(motion.force_N.begin(), motion.force_N.end(), std::numeric_limits<double>::quiet_NaN());
    result.problems.push_back({"no_force", "the force never changes: all of the path counts as scanned", 1});
  }
  return result;
}

void measure_along(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                   ProcessResult& result, const Observer& observer) {
  const bool trustworthy = result.trustworthy;
  if (attempt(result, "no_profile", "profile", [&] { find_profile(config, find_base, result, observer); })) {
    measure_surface(recording, config, result, observer);
    judge_coverage(result, config);
  }
  // What fails where nothing was felt is said, not held against the motion.
  if (!has_force(recording.probe) && trustworthy) {
    result.trustworthy = true;
    result.verdict.clear();
  }
  if (recording.truth) compare_with_truth(recording, config, result);
  observer.update("texture", 1.0);
}

ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  ProcessResult result = estimate_motion(recording, config, observer);
  const FindBase find_base = [&](const TipMotion& motion) {
    return find_base_path(motion, recording.calibration.tip_in_marker_m, config.base);
  };
  measure_along(recording, config, find_base, result, observer);
  return result;
}

}  // namespace asperity
