#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/pipeline/scan_evidence.h"
#include "asperity/profile/stiffness_of_compliance.h"
#include "asperity/verdict/judge_scan.h"
#include "process_stages.h"

namespace asperity {

namespace {

template <class T>
void add_problems(ProcessResult& result, const Outcome<T>& outcome) {
  result.problems.insert(result.problems.end(), outcome.problems.begin(), outcome.problems.end());
}

// The contact's: measured, or charted from k_c where that is below what rigid surfaces have; not below the bound.
std::optional<double> rendered_stiffness_N_per_m(const ProcessResult& result) {
  if (result.stiffness.measured) return 1e3 * result.stiffness.stiffness_N_per_mm;
  const auto charted = stiffness_of_compliance(result.compliance);
  if (!charted || !std::isfinite(charted->high_N_per_mm)) return std::nullopt;
  const double bound_N_per_mm = result.stiffness.lower_bound_N_per_mm;
  return 1e3 * (bound_N_per_mm > charted->stiffness_N_per_mm ? bound_N_per_mm : charted->stiffness_N_per_mm);
}

}  // namespace

Texture join_texture(const std::string& object, const ProcessMethod& method, const ProcessResult& result) {
  Texture texture;
  texture.name = object;
  texture.model = result.fit->texture;
  texture.height_offset_m = result.fit->height_offset_m;
  if (std::isfinite(result.compliance.k_c)) texture.compliance_kc = result.compliance.k_c;
  texture.stiffness_N_per_m = rendered_stiffness_N_per_m(result);
  if (result.friction.determined) {
    texture.friction = std::max(0.0, result.friction.coefficient);  // one near 0 may come out below it
    if (std::isfinite(result.friction.static_ratio)) texture.static_friction_ratio = result.friction.static_ratio;
  }
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
  if (std::isfinite(result.noise.noise_rms_m)) texture.height_sigma_m = result.noise.noise_rms_m;
  if (std::isfinite(result.noise.snr)) texture.source.snr = result.noise.snr;
  ProcessConfig config = result.config;
  texture.source.config = config_json(list_fields("", config));
  texture.source.version = kVersion;
  return texture;
}

namespace {

// What was measured on the surface.
void add_surface(const Recording& recording, const ProcessMethod& method, ProcessStages& stages,
                 ProcessResult& result) {
  add_problems(result, stages.base);
  add_problems(result, stages.profile);
  add_problems(result, stages.roughness);
  add_problems(result, stages.fit);
  result.base = std::move(stages.base.value).value_or(BasePathResult{});
  if (!stages.profile.value) return;
  result.profile = std::move(stages.profile.value->profile);
  result.coverage = stages.profile.value->coverage;
  result.speed = stages.profile.value->speed;
  result.noise = std::move(stages.profile.value->noise);
  result.lines = std::move(stages.profile.value->lines);
  result.measured_profile = std::move(stages.profile.value->as_measured);
  result.measured_noise = std::move(stages.profile.value->noise_as_measured);
  result.surface = std::move(stages.profile.value->surface);
  result.roughness = std::move(stages.roughness.value);
  result.periodicity = std::move(stages.periodicity.value).value_or(Periodicity{});
  result.spectrum = std::move(stages.spectrum.value).value_or(SurfaceSpectrum{});
  result.compliance = std::move(stages.compliance.value).value_or(Compliance{});
  result.stiffness = std::move(stages.stiffness.value).value_or(StiffnessEstimate{});
  result.friction = std::move(stages.friction.value).value_or(FrictionEstimate{});
  result.force_limit = stages.force_limit;
  result.fit = std::move(stages.fit.value);
  if (result.fit) result.texture = join_texture(recording.info.object, method, result);
}

}  // namespace

ProcessResult join_stages(const Recording& recording, const ProcessConfig& config, const ProcessMethod& method,
                          ProcessStages stages) {
  ProcessResult result;
  result.config = config;
  result.problems = recording.problems;
  add_problems(result, stages.trajectory);
  result.trajectory = std::move(*stages.trajectory.value);

  add_surface(recording, method, stages, result);
  add_problems(result, stages.accuracy);
  result.accuracy = std::move(stages.accuracy.value);
  result.verdicts = judge_scan(scan_evidence(recording, result));
  result.trustworthy = is_trustworthy(result.verdicts);
  result.verdict = verdict_sentence(result.verdicts);
  return result;
}

}  // namespace asperity
