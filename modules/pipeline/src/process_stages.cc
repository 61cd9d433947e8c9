#include "process_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/version.h"
#include "asperity/pipeline/find_doubts.h"
#include "asperity/trajectory/reject_outliers.h"
#include "asperity/trajectory/sample_at_probe.h"

namespace asperity::stage {

namespace {

// The notes of a step that may not succeed.
template <class Step>
StageNotes attempt(const char* kind, const char* what, Step step) {
  StageNotes notes;
  try {
    step(notes);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    notes.problems.push_back({kind, std::string("no ") + what + ": " + error.what(), 1});
    notes.doubts.push_back(std::string("no ") + what);
    notes.failed = true;
  }
  return notes;
}

TrajectoryResult estimate_trajectory(const Recording& recording, const ProcessConfig& config,
                                     const Observer& observer) {
  if (config.method == Method::kFused) return estimate_trajectory_fused(recording, config.fused, observer);
  return estimate_trajectory_thesis(recording, config.thesis.trajectory);
}

Profile make_profile_by(const ProcessConfig& config, const TipMotion& motion, const BasePathResult& base) {
  if (config.method == Method::kFused) return make_profile(motion, base.path, base.contact, config.profile);
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

}  // namespace

bool has_force(const ProbeStream& probe) {
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const double counts : probe.force_counts) {
    if (!std::isfinite(counts)) continue;
    if (std::isfinite(first) && counts != first) return true;
    first = counts;
  }
  return false;
}

StageNotes find_trajectory(const Recording& recording, const ProcessConfig& config, ProcessResult& result,
                           const Observer& observer) {
  result.trajectory = estimate_trajectory(recording, config, observer);
  TipMotion& motion = result.trajectory.motion;
  StageNotes notes;
  notes.problems = result.trajectory.problems;
  if (!result.trajectory.trustworthy) notes.doubts.push_back(result.trajectory.verdict);
  for (std::string& doubt : find_doubts(recording, result.trajectory)) notes.doubts.push_back(std::move(doubt));

  // Without a force sensor a motion need not be a scan.
  if (!has_force(recording.probe)) {
    std::fill(motion.force_N.begin(), motion.force_N.end(), std::numeric_limits<double>::quiet_NaN());
    notes.problems.push_back({"no_force", "the force never changes: all of the path counts as scanned", 1});
  }
  return notes;
}

StageNotes find_base_path(const FindBase& find_base, ProcessResult& result) {
  return attempt("no_profile", "profile", [&](StageNotes& notes) {
    result.base = {};
    result.base = find_base(result.trajectory.motion);
    notes.problems = result.base.problems;
  });
}

StageNotes find_profile(const ProcessConfig& config, ProcessResult& result) {
  return attempt("no_profile", "profile", [&](StageNotes&) {
    result.profile = {};
    result.coverage = {};
    result.speed = {};
    result.profile = make_profile_by(config, result.trajectory.motion, result.base);
    result.coverage = measure_coverage(result.profile);
    result.speed = measure_speed(result.profile);
  });
}

StageNotes measure_roughness(const RoughnessConfig& config, ProcessResult& result) {
  return attempt("no_roughness", "roughness", [&](StageNotes&) {
    result.roughness.reset();
    result.roughness = asperity::measure_roughness(result.profile.texture_m, result.profile.spacing_m, config);
  });
}

StageNotes find_periodicity(const PeriodicityConfig& config, ProcessResult& result) {
  result.periodicity = asperity::find_periodicity(result.profile.texture_m, result.profile.spacing_m, config);
  return {};
}

StageNotes estimate_compliance(const Recording& recording, const ProcessConfig& config, ProcessResult& result) {
  const TipMotion& motion = result.trajectory.motion;
  const std::vector<Eigen::Vector3d>& n_world = result.base.path.n_world;
  if (config.method == Method::kFused) {
    result.compliance = asperity::estimate_compliance(motion, motion.t_ns, n_world, config.compliance);
    return {};
  }
  // It wants accelerations at the probe's own rate, which the seed's motion has thinned.
  const Outliers outliers = reject_outliers(recording.probe, recording.calibration, config.thesis.trajectory.outliers);
  const TipMotion samples =
      sample_at_probe(recording.probe, outliers, recording.calibration, recording.info.gravity_world_mps2, motion);
  result.compliance = asperity::estimate_compliance(samples, motion.t_ns, n_world, config.compliance);
  return {};
}

StageNotes estimate_stiffness(const StiffnessConfig& config, ProcessResult& result) {
  result.stiffness =
      asperity::estimate_stiffness(result.trajectory.motion, result.base.path, result.base.contact, config);
  return {};
}

StageNotes fit_texture(const FitFourier1dConfig& config, ProcessResult& result) {
  return attempt("no_texture", "texture", [&](StageNotes& notes) {
    result.fit.reset();
    result.fit = fit_fourier1d(result.profile.texture_m, result.profile.spacing_m, config);
    notes.problems = result.fit->problems;
  });
}

Texture join_texture(const Recording& recording, const ProcessConfig& config, const ProcessResult& result) {
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

StageNotes compare_with_truth(const Recording& recording, const ComparisonConfig& config, ProcessResult& result) {
  StageNotes notes;
  result.accuracy.reset();
  try {
    result.accuracy = measure_accuracy(recording, result.trajectory.motion, result.profile, config);
  } catch (const Error& error) {
    notes.problems.push_back({"no_accuracy", std::string("not compared with the truth: ") + error.what(), 1});
  }
  return notes;
}

}  // namespace asperity::stage
