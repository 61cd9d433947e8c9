#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/units.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/stiffness_of_compliance.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/verdict/judge_passes.h"
#include "asperity/verdict/verdict_json.h"
#include "json.h"

namespace asperity {

namespace {

double stream_span_s(const std::vector<std::int64_t>& t_ns) {
  return t_ns.size() < 2 ? 0.0 : static_cast<double>(t_ns.back() - t_ns.front()) * kNanosecond_s;
}

Json base_json(const BasePathResult& base) {
  Json out;
  out["shape"] = kPathShapeNames.at(static_cast<std::size_t>(base.shape));
  out["shape_probability"] = base.shape_probability;
  out["centre_world_m"] = vector_json(base.centre_world_m);
  out["axis_world"] = vector_json(base.axis_world);
  if (base.shape == PathShape::kCircle) {
    out["radius_m"] = base.radius_m;
    out["radius_stderr_m"] = base.radius_stderr_m;
    out["outside"] = base.outside;
  }
  if (base.shape == PathShape::kDoublyCurved) {
    out["curvatures_per_m"] = {base.curvatures_per_m.x(), base.curvatures_per_m.y()};
  }
  if (base.shape == PathShape::kCircle || base.shape == PathShape::kCurve) {
    out["lean_deg"] = base.lean_rad * 180.0 / std::numbers::pi;
  }
  if (!base.tip_s_m.empty()) {
    out["indentation_m"] = base.indentation_m;
    out["indentation_stderr_m"] = base.indentation_sigma_m;
  }
  out["normal_sigma_deg"] = base.normal_sigma_deg;
  out["probe_tilt_deg"] = base.probe_tilt_deg;
  out["base_rms_m"] = base.base_rms_m;
  out["turning_points"] = base.turning_points.size();
  out["undetermined"] = Json::array();
  for (const UndeterminedRotation& one : base.undetermined) {
    out["undetermined"].push_back({{"freedom", one.description}, {"sigma_deg", one.sigma_deg}});
  }
  return out;
}

Json vibrations_json(const std::vector<TimeLine>& lines) {
  Json out = Json::array();
  for (const TimeLine& line : lines) {
    out.push_back({{"frequency_Hz", line.frequency_Hz},
                   {"resolution_Hz", line.resolution_Hz},
                   {"rms_m", line.rms_m},
                   {"could_be_surface", line.could_be_surface}});
  }
  return out;
}

Json roughness_json(const RoughnessResult& r) {
  Json out;
  for (const RoughnessParameter& p : kRoughnessParameters) {
    const std::string unit = p.is_length ? "_m" : "";
    out[std::string(p.name) + unit] = r.*p.value;
    out[std::string(p.name) + "_stderr" + unit] = r.standard_error.*p.value;
  }
  out["samples"] = r.samples;
  out["missing"] = r.missing;
  return out;
}

Json periodicity_json(const Periodicity& p) {
  Json out{{"periodic", p.periodic},
           {"pitch_m", p.pitch_m},
           {"pitch_stderr_m", p.pitch_stderr_m},
           {"depth_m", p.depth_m},
           {"depth_stderr_m", p.depth_stderr_m},
           {"strength", p.strength},
           {"periods", p.periods}};
  if (std::isfinite(p.across_pitch_m)) {
    out["across_pitch_m"] = p.across_pitch_m;
    out["across_pitch_stderr_m"] = p.across_pitch_stderr_m;
  }
  return out;
}

Json compliance_json(const Compliance& c) {
  const auto charted = stiffness_of_compliance(c);
  return {{"determined", c.determined},
          {"charted_stiffness_N_per_mm", charted ? Json(charted->stiffness_N_per_mm) : Json(nullptr)},
          {"charted_stiffness_low_N_per_mm", charted ? Json(charted->low_N_per_mm) : Json(nullptr)},
          {"charted_stiffness_high_N_per_mm", charted ? Json(charted->high_N_per_mm) : Json(nullptr)},
          {"k_c", c.k_c},
          {"k_c_stderr", c.k_c_stderr},
          {"k_c_low", c.k_c_low},
          {"k_c_high", c.k_c_high},
          {"standard_forces_N", {kStandardLightest_N, kStandardFirmest_N}},
          {"sigma_r2", c.sigma_r2},
          {"force_exponent", c.exponent},
          {"force_exponent_stderr", c.exponent_error},
          {"lightest_N", c.lightest_N},
          {"firmest_N", c.firmest_N},
          {"windows", c.windows.size()},
          {"lost_fraction", c.lost_fraction},
          {"verdict", c.verdict}};
}

Json force_json(const NormalForce& f) {
  return {{"source", kForceSourceNames.at(static_cast<std::size_t>(f.source))},
          {"axial_share", f.share},
          {"relative_sigma", f.relative_sigma},
          {"tangential_share", f.tangential_share}};
}

Json friction_json(const FrictionEstimate& f) {
  Json out = {{"determined", f.determined},
              {"coefficient", f.coefficient},
              {"coefficient_stderr", f.standard_error},
              {"low", f.low},
              {"high", f.high},
              {"speed_mps", f.speed_mps},
              {"force_N", f.force_N},
              {"per_mps", f.per_mps},
              {"per_mps_stderr", f.per_mps_stderr},
              {"per_log_force", f.per_log_force},
              {"per_log_force_stderr", f.per_log_force_stderr},
              {"spread_rad", f.spread_rad},
              {"sensor_delay_s", f.sensor_delay_s},
              {"sticks", f.sticks},
              {"stuck_share", f.stuck_share},
              {"breakaway", f.breakaway},
              {"breakaway_stderr", f.breakaway_stderr},
              {"static_ratio", f.static_ratio},
              {"static_ratio_stderr", f.static_ratio_stderr},
              {"windows", f.windows.size()},
              {"verdict", f.verdict}};
  out["stribeck"] = nullptr;
  if (f.stribeck) {
    out["stribeck"] = {
        {"at_rest", f.stribeck->at_rest}, {"sliding", f.stribeck->sliding}, {"speed_mps", f.stribeck->speed_mps}};
  }
  return out;
}

Json stiffness_json(const StiffnessEstimate& s) {
  return {{"measured", s.measured},
          {"stiffness_N_per_mm", s.stiffness_N_per_mm},
          {"stiffness_stderr_N_per_mm", s.stiffness_stderr_N_per_mm},
          {"lower_bound_N_per_mm", s.lower_bound_N_per_mm},
          {"upper_bound_N_per_mm", s.upper_bound_N_per_mm},
          {"compliance_mm_per_N", s.compliance_mm_per_N},
          {"compliance_stderr_mm_per_N", s.compliance_stderr_mm_per_N},
          {"force_rms_N", s.force_rms_N},
          {"band_high_hz", s.band_high_hz},
          {"used_s", s.used_s},
          {"verdict", s.verdict}};
}

Json tip_json(const ErodedProfile& surface) {
  return {{"determined", surface.determined},
          {"reason", surface.reason},
          {"radius_m", surface.radius_m},
          {"touched_share", surface.touched_share},
          {"correction_rms_m", surface.correction_rms_m},
          {"noise_rms_m", surface.noise_rms_m},
          {"bias_m", surface.bias_m}};
}

Json passes_json(const MergedProfile& merged) {
  Json passes = Json::array();
  for (const MergedPass& pass : merged.passes) {
    passes.push_back({{"name", pass.name},
                      {"used", pass.used},
                      {"direction", pass.alignment.reversed ? "backward" : "forward"},
                      {"shift_m", pass.shift_m},
                      {"stretch", pass.stretch},
                      {"warp_rms_m", pass.warp_rms_m},
                      {"coherence", pass.coherence},
                      {"weight", pass.weight},
                      {"noise_rms_m", pass.noise_rms_m},
                      {"stated_noise_rms_m", pass.stated_noise_rms_m},
                      {"score", pass.alignment.score},
                      {"threshold", pass.alignment.threshold}});
  }
  return passes;
}

Json closest_json(const MergedProfile& merged) {
  const PassPair& pair = merged.closest;
  if (!std::isfinite(pair.ratio)) return nullptr;
  return {{"names", {merged.passes[pair.first].name, merged.passes[pair.second].name}},
          {"ratio", pair.ratio},
          {"ratio_high", pair.ratio_high}};
}

// Whether passes agree, and what their differences say of the stated noise.
Json merge_of_passes_json(const MergedProfile& merged) {
  const PassEvidence evidence{merged.noise_ratio, merged.noise_ratio_low, merged.noise_ratio_high};
  return {{"agrees", merged.agrees},
          {"used", merged.used},
          {"noise_ratio", merged.noise_ratio},
          {"noise_ratio_low", merged.noise_ratio_low},
          {"noise_ratio_high", merged.noise_ratio_high},
          {"noise_scale", merged.noise_scale},
          {"apart_m", merged.apart_m},
          {"lines_over_noise", merged.lines_over_noise},
          {"closest", closest_json(merged)},
          {"stated_sigma", std::string(witness_word(witness_of_passes(evidence)))}};
}

Json accuracy_json(const Accuracy& accuracy) {
  Json out;
  out["position_rms_m"] = accuracy.position_rms_m;
  out["tracker_rms_m"] = accuracy.tracker_rms_m;
  out["position_error_over_sigma"] = accuracy.position_error_over_sigma;
  out["positions_compared"] = accuracy.compared;
  if (accuracy.profile) {
    const ProfileComparison& p = *accuracy.profile;
    out["band_high_cycles_per_mm"] = accuracy.band_high_cycles_per_mm;
    out["correlation"] = p.correlation;
    out["gain"] = p.gain;
    out["rms_um"] = p.rms_um;
    out["true_rms_um"] = p.true_rms_um;
    out["shift_m"] = p.shift_m;
    out["length_error_percent"] = p.length_error_percent;
    out["compared_m"] = p.compared_m;
  }
  return out;
}

}  // namespace

Json lines_json(std::span<const RepeatedLine> lines) {
  Json out = Json::array();
  for (const RepeatedLine& line : lines) {
    Json one = merge_of_passes_json(line.merged);
    one["laid"] = line.laid;
    one["reason"] = line.reason;
    one["passes"] = passes_json(line.merged);
    for (std::size_t k = 0; k < line.spans.size(); ++k) {
      one["passes"][k]["from_m"] = line.spans[k].from_m;
      one["passes"][k]["to_m"] = line.spans[k].to_m;
    }
    out.push_back(std::move(one));
  }
  return out;
}

Json result_json(const ProcessResult& result, const Recording& recording, const std::string& name) {
  ProcessConfig config = result.config;
  Json out;
  out["format"] = "asperity-result";
  out["version"] = 1;
  out["recording"] = name;
  out["object"] = recording.info.object;
  out["probe"] = recording.info.probe_model;
  out["method"] = kMethodNames.at(static_cast<std::size_t>(config.method));
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict;
  out["verdicts"] = verdicts_json(result.verdicts);
  out["duration_s"] = stream_span_s(result.trajectory.motion.t_ns);
  out["samples"] = {{"probe", recording.probe.size()},
                    {"tracker", recording.tracker.size()},
                    {"motion", result.trajectory.motion.size()},
                    {"profile", result.profile.size()}};
  if (recording.probe.size() + recording.tracker.size() > 0)
    out["fingerprint"] = fingerprint_json(fingerprint_of(recording));
  out["length_m"] = result.base.length_m;
  out["length_stderr_m"] = result.noise.length_stderr_m;
  out["profile"] = {{"length_m", result.coverage.length_m},
                    {"length_stderr_m", result.noise.length_stderr_m},
                    {"covered", result.coverage.covered},
                    {"gaps", result.coverage.gaps},
                    {"spacing_m", result.profile.spacing_m},
                    {"texture_rms_m", result.noise.texture_rms_m},
                    {"noise_rms_m", result.noise.noise_rms_m},
                    {"noise_rms_stderr_m", result.noise.noise_rms_stderr_m},
                    {"added_noise_rms_m", result.noise.added_rms_m},
                    {"place_sigma_m", result.noise.place_sigma_m},
                    {"end_place_sigma_m", result.noise.end_place_sigma_m},
                    {"stretch_correlation", result.noise.stretch_correlation},
                    {"snr", result.noise.snr},
                    {"snr_low", result.noise.snr_low},
                    {"expected_correlation", result.noise.expected_correlation},
                    {"at_most_m", result.noise.at_most_m},
                    {"vibrations", vibrations_json(result.noise.time_lines)},
                    {"high_pass_cycles_per_mm", ProcessMethods::get(config.method).high_pass_cycles_per_mm(config)}};
  out["speed_mps"] = {
      {"mean", result.speed.mean_mps}, {"lowest", result.speed.lowest_mps}, {"highest", result.speed.highest_mps}};
  out["base"] = base_json(result.base);
  if (result.trajectory.object) out["frame"] = "object";
  out["trajectory"] = Json(result.trajectory.metrics);
  out["roughness"] = result.roughness ? roughness_json(*result.roughness) : Json(nullptr);
  out["periodicity"] = periodicity_json(result.periodicity);
  out["compliance"] = compliance_json(result.compliance);
  out["force"] = force_json(result.base.force);
  out["stiffness"] = stiffness_json(result.stiffness);
  out["friction"] = friction_json(result.friction);
  if (result.fit) {
    out["texture"] = {{"file", "texture.json"},
                      {"start_m", result.profile.s_m.at(result.fit->first_sample)},
                      {"length_mm", result.fit->texture.length_mm},
                      {"harmonics", result.fit->texture.a_m.size()},
                      {"rms_height_m", result.fit->rms_height_m},
                      {"rms_error_m", result.fit->rms_error_m},
                      {"lift_m", result.fit->height_offset_m}};
  } else {
    out["texture"] = nullptr;
  }
  if (result.surface) out["tip"] = tip_json(*result.surface);
  if (result.passes) {
    out["passes"] = passes_json(*result.passes);
    out["merge"] = merge_of_passes_json(*result.passes);
  }
  if (!result.lines.empty()) out["lines"] = lines_json(result.lines);
  if (result.accuracy) out["accuracy"] = accuracy_json(*result.accuracy);
  out["problems"] = problems_json(result.problems);
  out["config"] = config_json(list_fields("", config));
  out["asperity"] = kVersion;
  return out;
}

std::string format_result(const ProcessResult& result, const Recording& recording, const std::string& name) {
  return result_text(result_json(result, recording, name));
}

std::string result_text(const Json& json) {
  // Names come from files; what is not UTF-8 in them must not stop the writing.
  return json.dump_repaired(2) + "\n";
}

}  // namespace asperity
