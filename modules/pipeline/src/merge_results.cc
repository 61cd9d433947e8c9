#include "asperity/pipeline/merge_results.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/config_json.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/texture/texture_file.h"
#include "asperity/verdict/judge_passes.h"
#include "asperity/verdict/verdict_codes.h"
#include "process_stages.h"
#include "repeated_lines.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestPassFile_bytes = 512ULL << 20;
constexpr double kInvisible_snr = 2.0, kNoisy_snr = 5.0;  // as judge_scan() has it
// Two strokes differ by the noise of both. Noise is known to a factor of about 2 in power; below half of that again it
// is the same noise in both.
constexpr double kDependent = 0.25;

double number_or(const Json& json, const char* key, double otherwise) {
  return json.contains(key) && json.at(key).is_number() ? json.at(key).get<double>() : otherwise;
}

// Heights and texture, evenly spaced.
Profile read_profile(const fs::path& file) {
  const std::string text = read_file(file, kLargestPassFile_bytes);
  CsvReader table(text, printable(file.string(), 200));
  const std::size_t s = table.require("s_m"), height = table.require("height_m"), texture = table.require("texture_m");
  Profile out;
  while (table.next()) {
    out.s_m.push_back(table.finite(s));
    out.height_m.push_back(table.finite_or_nan(height));
    out.texture_m.push_back(table.finite_or_nan(texture));
  }
  if (out.size() < 2 || !(out.s_m.back() > out.s_m.front())) table.fail("fewer than two points, or s_m does not rise");
  out.spacing_m = (out.s_m.back() - out.s_m.front()) / static_cast<double>(out.size() - 1);
  return out;
}

// That a stroke does not stand out of its noise is no fault of it: strokes are merged for that, and the merge's own
// noise is judged.
bool counts_in_merge(std::string_view code) { return code != "below_noise"; }

std::string invalid_verdicts(const Verdicts& verdicts) {
  Verdicts counted;
  for (const Verdict& verdict : verdicts) {
    if (verdict.severity == Severity::kInvalid && counts_in_merge(verdict.code)) counted.push_back(verdict);
  }
  return counted.empty() ? "" : counted.front().message;
}

// The same of a result.json; empty: it is not invalid.
std::string invalid_of(const Json& result) {
  const Json* trustworthy = result.find("trustworthy");
  if (trustworthy == nullptr || !trustworthy->is_boolean()) return "its result states no verdict";
  if (*trustworthy == Json(true)) return {};
  const Json* verdicts = result.find("verdicts");
  bool only_noise = false;
  for (std::size_t i = 0; verdicts != nullptr && verdicts->is_array() && i < verdicts->size(); ++i) {
    const Json& verdict = verdicts->at(i);
    if (!verdict.is_object() || verdict.value("severity", "") != "invalid") continue;
    if (counts_in_merge(verdict.value("code", ""))) return printable(verdict.value("message", "invalid"), 300);
    only_noise = true;
  }
  return only_noise ? "" : "its result is invalid";
}

void judge_strokes(const MergedProfile& merged, std::span<const MergeStroke> strokes, Verdicts& out) {
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    if (!merged.passes[k].used || strokes[k].invalid.empty()) continue;
    out.push_back(make_verdict("stroke_invalid", printable(strokes[k].pass.name, 200) + ": " + strokes[k].invalid));
  }
}

void judge_merged_noise(const MergedProfile& merged, const TextureNoise& noise, Verdicts& out) {
  if (!std::isfinite(noise.snr)) {
    out.push_back(make_verdict("error_unknown", "the noise of the merge is not known: not all strokes state theirs"));
  } else if (noise.snr < kInvisible_snr) {
    out.push_back(make_verdict("below_noise", "the merged texture is not above its noise"));
  } else if (noise.snr < kNoisy_snr) {
    out.push_back(make_verdict("noisy_texture", fmt::format("of the texture's {:.3g} µm RMS {:.3g} µm are expected to "
                                                            "be noise",
                                                            1e6 * noise.texture_rms_m, 1e6 * noise.noise_rms_m)));
  }
  if (!std::isfinite(merged.noise_ratio_low) || !std::isfinite(merged.closest.ratio_high)) {
    out.push_back(make_verdict("passes_uncompared",
                               "the difference between the strokes is not determined: all of them together share less "
                               "than 12.8 mm of the line, or state no noise"));
  }
}

Verdicts judge_merge(const MergedProfile& merged, const TextureNoise& noise, std::span<const MergeStroke> strokes) {
  Verdicts out;
  if (!merged.agrees) {
    out.push_back(make_verdict("no_common_line", "these strokes did not pass over the same line"));
    return out;
  }
  if (const PassPair& pair = merged.closest; pair.ratio_high < kDependent) {
    out.push_back(make_verdict(
        "passes_dependent",
        fmt::format("{} and {} differ by {:.2g} times the power of the noise that they state, 95 %: at most {:.2g}; "
                    "they are not two measurements",
                    printable(merged.passes[pair.first].name, 200), printable(merged.passes[pair.second].name, 200),
                    pair.ratio, pair.ratio_high)));
  }
  judge_strokes(merged, strokes, out);
  judge_merged_noise(merged, noise, out);
  std::string left, unlaid;
  for (const MergedPass& pass : merged.passes) {
    if (pass.used) continue;
    std::string& names = pass.laid ? left : unlaid;
    names += (names.empty() ? "" : ", ") + printable(pass.name, 200);
  }
  if (!unlaid.empty())
    out.push_back(make_verdict("passes_left_out", "these passes could not be aligned with the others: " + unlaid));
  if (!left.empty())
    out.push_back(make_verdict("passes_left_out", "these passes are not over the same line as the others: " + left));
  judge_passes({merged.noise_ratio, merged.noise_ratio_low, merged.noise_ratio_high}, out);
  return out;
}

}  // namespace

ProfilePass pass_of_result(const ProcessResult& result, const std::string& name) {
  return profile_pass(name, result.profile, result.profile.texture_m, result.noise, 0, result.profile.size());
}

MergeStroke stroke_of_result(const ProcessResult& result, const Recording& recording, const std::string& name) {
  return {pass_of_result(result, name), fingerprint_of(recording), invalid_verdicts(result.verdicts)};
}

MergeStroke read_stroke(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / "result.json";
  const Json result = parse_json(read_file(file, kLargestPassFile_bytes), printable(file.string(), 200));
  const auto wrong = [&](const std::string& what) { throw Error(printable(file.string(), 200) + ": " + what); };
  if (!result.is_object() || result.value("format", "") != "asperity-result") wrong("not a result of asperity");
  if (!result.contains("profile") || !result.at("profile").is_object()) wrong("without a profile");
  const Json* group = result.contains("config") ? &result.at("config") : nullptr;
  for (const char* name_of : {"process", "profile"}) {
    if (group != nullptr && group->is_object() && group->contains(name_of)) group = &group->at(name_of);
  }
  const bool removed = group != nullptr && group->is_object() && group->contains("remove_noise") &&
                       group->at("remove_noise") == Json(true);
  if (removed) {
    wrong(
        "the noise was removed from its heights; merge the recording, or process it with "
        "profile.remove_noise=false");
  }
  const Profile profile = read_profile(folder / "profile.csv");
  const Json& stated = result.at("profile");
  TextureNoise noise;
  noise.added_rms_m = number_or(stated, "added_noise_rms_m", kNan);
  const double rms_m = number_or(stated, "noise_rms_m", kNan);
  noise.added_rms_stderr_m = noise.added_rms_m * number_or(stated, "noise_rms_stderr_m", kNan) / rms_m;
  if (!std::isfinite(noise.added_rms_stderr_m)) noise.added_rms_m = 0.0;
  noise.place_sigma_m = number_or(stated, "place_sigma_m", kNan);
  noise.along_sigma = number_or(stated, "length_stderr_m", kNan) / number_or(stated, "length_m", kNan);
  const std::string text = read_file(folder / "spectrum.csv", kLargestPassFile_bytes);
  CsvReader spectrum(text, printable((folder / "spectrum.csv").string(), 200));
  const std::size_t frequency = spectrum.require("cycles_per_mm"), density = spectrum.require("noise_m2_mm");
  while (spectrum.next()) {
    const double value = spectrum.finite_or_nan(density);
    if (!std::isfinite(value)) continue;
    if (value < 0.0) spectrum.fail(density, "a negative density");
    noise.frequency_cycles_per_mm.push_back(spectrum.finite(frequency));
    noise.added_psd_m2_mm.push_back(value);
  }
  return {profile_pass(name, profile, profile.texture_m, noise, 0, profile.size()),
          result.contains("fingerprint") ? parse_fingerprint(result.at("fingerprint")) : Fingerprint{},
          invalid_of(result)};
}

ProcessResult merge_results(std::span<const MergeStroke> strokes, const std::string& object,
                            const MergeConfig& config) {
  std::vector<ProfilePass> passes;
  std::vector<NamedFingerprint> measured_from;
  for (const MergeStroke& stroke : strokes) {
    passes.push_back(stroke.pass);
    measured_from.push_back({stroke.pass.name, stroke.fingerprint});
  }
  check_independent(measured_from);
  MergedProfile merged = merge_passes(passes, config.align);
  ProcessResult out;
  out.config = config.process;
  if (merged.agrees) {
    ProcessStages stages;
    MeasuredProfile& measured = stages.profile.value.emplace();
    measured.profile = std::move(merged.profile);
    measured.noise = merged.noise;
    measured.measured_texture_m = measured.profile.texture_m;
    if (config.process.profile.remove_noise)
      remove_noise(config.process.profile.bridge_m, measured.profile, measured.noise);
    measured.coverage = measure_coverage(measured.profile);
    stages.periodicity = stage::find_periodicity(config.process, stages);
    stages.roughness = stage::measure_roughness(config.process, stages);
    stages.spectrum = stage::measure_spectrum(stages);
    stages.fit = stage::fit_texture(config.process, stages);
    for (const Problems* problems : {&stages.roughness.problems, &stages.fit.problems})
      out.problems.insert(out.problems.end(), problems->begin(), problems->end());
    out.profile = std::move(measured.profile);
    out.noise = std::move(measured.noise);
    out.coverage = measured.coverage;
    out.roughness = std::move(stages.roughness.value);
    out.periodicity = std::move(stages.periodicity.value).value_or(Periodicity{});
    out.spectrum = std::move(stages.spectrum.value).value_or(SurfaceSpectrum{});
    out.fit = std::move(stages.fit.value);
    if (out.fit) out.texture = join_texture(object, ProcessMethods::get(config.process.method), out);
  }
  merged.profile = {};
  out.verdicts = judge_merge(merged, out.noise, strokes);
  sort_verdicts(out.verdicts);
  out.trustworthy = is_trustworthy(out.verdicts);
  out.verdict = verdict_sentence(out.verdicts);
  out.passes = std::move(merged);
  return out;
}

Json merge_json(const ProcessResult& result, const MergeConfig& config, const std::string& object) {
  Recording recording;
  recording.info.object = object;
  Json out = result_json(result, recording, object);
  MergeConfig copy = config;
  out["config"] = config_json(list_fields("", copy));
  return out;
}

void write_merge(const fs::path& folder, const ProcessResult& result, const MergeConfig& config,
                 const std::string& object) {
  write_file(folder / "profile.csv", format_profile_csv(result.profile));
  write_file(folder / "spectrum.csv", format_spectrum_csv(result.spectrum));
  if (result.texture) {
    Texture texture = *result.texture;
    texture.source.recording = object;
    write_texture(folder / "texture.json", texture);
  }
  write_file(folder / "result.json", merge_json(result, config, object).dump_repaired(2) + "\n");
}

}  // namespace asperity
