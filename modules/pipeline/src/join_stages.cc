#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "process_stages.h"

namespace asperity {

namespace {

void mark_untrusted(ProcessResult& result, const std::string& why) {
  result.trustworthy = false;
  result.verdict += (result.verdict.empty() ? "" : "; ") + why;
}

template <class T>
void add_notes(ProcessResult& result, const Outcome<T>& outcome) {
  result.problems.insert(result.problems.end(), outcome.problems.begin(), outcome.problems.end());
  for (const std::string& warning : outcome.quality_warnings) mark_untrusted(result, warning);
}

void judge_coverage(ProcessResult& result) {
  if (result.coverage.covered < result.config.min_coverage) {
    const int percent = static_cast<int>(std::lround(100.0 * result.coverage.covered));
    mark_untrusted(result, "only " + std::to_string(percent) + " % of the profile has heights");
  }
}

Texture join_texture(const Recording& recording, const ProcessMethod& method, const ProcessResult& result) {
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
  const double low = method.high_pass_cycles_per_mm(result.config);
  const double fit_high = static_cast<double>(result.fit->texture.a_m.size()) / result.fit->texture.length_mm;
  const double nyquist = 0.5 / (result.profile.spacing_m * 1e3);
  texture.band_cycles_per_mm = {low, std::min(fit_high, nyquist)};
  ProcessConfig config = result.config;
  texture.source.config_json = config_json(list_fields("", config)).dump(2);
  texture.source.version = kVersion;
  return texture;
}

// What was measured on the surface, and what speaks against it.
void add_surface(const Recording& recording, const ProcessMethod& method, ProcessStages& stages,
                 ProcessResult& result) {
  add_notes(result, stages.base);
  add_notes(result, stages.profile);
  add_notes(result, stages.roughness);
  add_notes(result, stages.fit);
  result.base = std::move(stages.base.value).value_or(BasePathResult{});
  if (!stages.profile.value) return;
  result.profile = std::move(stages.profile.value->profile);
  result.coverage = stages.profile.value->coverage;
  result.speed = stages.profile.value->speed;
  result.roughness = std::move(stages.roughness.value);
  result.periodicity = std::move(stages.periodicity.value).value_or(Periodicity{});
  result.compliance = std::move(stages.compliance.value).value_or(Compliance{});
  result.stiffness = std::move(stages.stiffness.value).value_or(StiffnessEstimate{});
  result.fit = std::move(stages.fit.value);
  if (result.fit) result.texture = join_texture(recording, method, result);
  judge_coverage(result);
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

ProcessResult join_stages(const Recording& recording, const ProcessConfig& config, const ProcessMethod& method,
                          ProcessStages stages) {
  ProcessResult result;
  result.config = config;
  result.problems = recording.problems;
  add_notes(result, stages.trajectory);
  result.trajectory = std::move(*stages.trajectory.value);

  const bool motion_is_trusted = result.trustworthy;
  add_surface(recording, method, stages, result);
  // What fails where nothing was felt is said, not held against the motion.
  if (!has_force(recording.probe) && motion_is_trusted) {
    result.trustworthy = true;
    result.verdict.clear();
  }
  add_notes(result, stages.accuracy);
  result.accuracy = std::move(stages.accuracy.value);
  return result;
}

}  // namespace asperity
