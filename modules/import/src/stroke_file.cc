#include "asperity/import/stroke_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "asperity/base/crc32.h"
#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "asperity/import/stroke_spectra.h"
#include "asperity/json/parse_json.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity {

namespace {

constexpr const char* kFormat = "asperity-stroke";

struct Column {
  const char* name;
  const std::vector<double>* values;
};

// A table of the columns that are there.
std::string csv_of(const std::vector<Column>& columns) {
  std::vector<Column> there;
  for (const Column& column : columns)
    if (!column.values->empty()) there.push_back(column);
  std::string out;
  for (std::size_t k = 0; k < there.size(); ++k) out += std::string(k == 0 ? "" : ",") + there[k].name;
  out += '\n';
  for (std::size_t i = 0; !there.empty() && i < there.front().values->size(); ++i) {
    for (std::size_t k = 0; k < there.size(); ++k) {
      if (k > 0) out += ',';
      append_number(out, (*there[k].values)[i]);
    }
    out += '\n';
  }
  return out;
}

Json evidence_json(const StrokeEvidence& e) {
  return {{"largest_speed_mps", e.largest_speed_mps},
          {"largest_force_N", e.largest_force_N},
          {"contact_s", e.contact_s},
          {"moving_s", e.moving_s},
          {"quiet", kStrokeQuietNames.at(static_cast<std::size_t>(e.quiet))},
          {"active_s", e.active_s},
          {"quiet_s", e.quiet_s},
          {"active_mps2", e.active_mps2},
          {"quiet_mps2", e.quiet_mps2},
          {"power_ratio", number_or_null(e.power_ratio)},
          {"power_ratio_sigma", number_or_null(e.power_ratio_sigma)},
          {"power_ratio_chance", number_or_null(e.power_ratio_chance)},
          {"speed_exponent", number_or_null(e.speed_exponent)},
          {"speed_exponent_sigma", number_or_null(e.speed_exponent_sigma)},
          {"speed_exponent_margin", number_or_null(e.speed_exponent_margin)}};
}

const char* known_by(const std::vector<double>& values, bool measured) {
  return values.empty() ? "no" : measured ? "measured" : "stated";
}

bool is_measured(const Json& json, const char* key, bool there, const std::string& file) {
  const Json& value = json.at(key);
  for (const char* known : {"measured", "stated", "no"})
    if (value == known && there == (std::string_view(known) != "no")) return std::string_view(known) == "measured";
  throw Error(fmt::format("{}: '{}' does not fit the columns of stroke.csv", file, key));
}

}  // namespace

std::vector<std::string> stroke_unknowns(const Stroke& stroke) {
  std::vector<std::string> out;
  if (!stroke.speed_is_measured) {
    out.emplace_back(stroke.speed_mps.empty()
                         ? "lengths, and the spectrum of the heights: no positions and no stated speed"
                         : "lengths, but by the stated speed: no positions");
  }
  if (!stroke.force_is_measured) {
    out.emplace_back(stroke.force_N.empty() ? "how the vibration depends on the force: no force"
                                            : "how the vibration depends on the force: it was stated, not measured");
  }
  if (stroke.axes < 3)
    out.emplace_back(fmt::format("vibration across the accelerometer's {}: fewer than three",
                                 stroke.axes == 1 ? "axis" : "two axes"));
  out.emplace_back("heights along a line (Ra, Rz): no orientations");
  return out;
}

Json write_stroke(const std::filesystem::path& folder, const Stroke& stroke, const std::vector<StrokeOrigin>& sources) {
  std::vector<double> t_s;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    t_s.push_back(stroke.start_s + static_cast<double>(i) / stroke.rate_Hz);
  const std::string series = csv_of({{"t_s", &t_s},
                                     {"acceleration_mps2", &stroke.acceleration_mps2},
                                     {"speed_mps", &stroke.speed_mps},
                                     {"force_N", &stroke.force_N},
                                     {"x_m", &stroke.x_m},
                                     {"y_m", &stroke.y_m},
                                     {"z_m", &stroke.z_m}});
  write_file(folder / "stroke.csv", series);
  const VibrationSpectrum vibration = vibration_spectrum(stroke);
  if (!vibration.density.empty()) {
    write_file(folder / "vibration.csv", csv_of({{"frequency_Hz", &vibration.frequency_Hz},
                                                 {"density_m2_s4_Hz", &vibration.density},
                                                 {"noise_m2_s4_Hz", &vibration.noise}}));
  }
  const StrokeHeightSpectrum height = stroke_height_spectrum(stroke);
  if (!height.density_m2_mm.empty()) {
    write_file(folder / "spectrum.csv", csv_of({{"cycles_per_mm", &height.cycles_per_mm},
                                                {"density_m2_mm", &height.density_m2_mm},
                                                {"noise_m2_mm", &height.noise_m2_mm}}));
  }
  const StrokeEvidence evidence = measure_stroke_evidence(stroke);
  const Verdicts verdicts = judge_stroke(evidence);
  Json out;
  out["format"] = kFormat;
  out["version"] = 1;
  out["rate_Hz"] = stroke.rate_Hz;
  out["start_s"] = stroke.start_s;
  out["samples"] = stroke.size();
  out["duration_s"] = static_cast<double>(stroke.size()) / stroke.rate_Hz;
  out["axes"] = stroke.axes;
  out["high_pass_Hz"] = stroke.high_pass_Hz;
  out["speed"] = known_by(stroke.speed_mps, stroke.speed_is_measured);
  out["force"] = known_by(stroke.force_N, stroke.force_is_measured);
  out["contact_N"] = stroke.contact_N;
  out["noise_mps2"] = stroke.noise_mps2;
  out["crc32"] = crc32(series);
  out["trustworthy"] = is_trustworthy(verdicts);
  out["verdict"] = verdict_sentence(verdicts);
  out["verdicts"] = verdicts_json(verdicts);
  out["evidence"] = evidence_json(evidence);
  out["not_determined"] = stroke_unknowns(stroke);
  out["sources"] = Json::array();
  for (const StrokeOrigin& source : sources)
    out["sources"].push_back({{"file", source.file},
                              {"bytes", source.bytes},
                              {"crc32", source.crc32},
                              {"columns", source.columns},
                              {"rate_Hz", source.rate_Hz}});
  out["problems"] = Json::array();
  for (const Problem& problem : stroke.problems)
    out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  write_file(folder / "stroke.json", out.dump_repaired(2) + "\n");
  return out;
}

bool is_stroke_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "stroke.json", ignored);
}

std::string source_beyond(const std::filesystem::path& folder, const std::vector<StrokeOrigin>& sources) {
  constexpr std::uint64_t kLargest_bytes = 1 << 20;
  try {
    const Json json = parse_json(read_file(folder / "stroke.json", kLargest_bytes));
    for (const Json& old : json.at("sources")) {
      const std::string name = old.at("file").get<std::string>();
      const bool is_there = std::any_of(sources.begin(), sources.end(), [&](const StrokeOrigin& source) {
        return source.file == name && old.at("crc32") == source.crc32;
      });
      if (!is_there) return "a stroke of " + printable(name, 80);
    }
    return "";
  } catch (const Error&) {
    return "what another command wrote";
  }
}

Stroke read_stroke_folder(const std::filesystem::path& folder, const ReadLimits& limits) {
  const std::string file = (folder / "stroke.json").string(), series = (folder / "stroke.csv").string();
  Stroke out;
  const std::string text = read_file(series, limits.csv_bytes);
  CsvReader csv(text, series);
  const std::size_t time = csv.require("t_s");
  std::vector<std::pair<std::size_t, std::vector<double>*>> columns{
      {csv.require("acceleration_mps2"), &out.acceleration_mps2}};
  for (const auto& [name, values] : {std::pair<const char*, std::vector<double>*>{"speed_mps", &out.speed_mps},
                                     {"force_N", &out.force_N},
                                     {"x_m", &out.x_m},
                                     {"y_m", &out.y_m},
                                     {"z_m", &out.z_m}}) {
    if (const auto column = csv.find(name)) columns.emplace_back(*column, values);
  }
  while (csv.next()) {
    const double t_s = csv.finite(time);
    if (out.acceleration_mps2.empty()) out.start_s = t_s;
    for (const auto& [column, values] : columns) values->push_back(csv.finite(column));
  }
  constexpr std::uint64_t kLargest_bytes = 1 << 20;
  try {
    const Json json = parse_json(read_file(file, kLargest_bytes));
    if (json.at("format") != kFormat || json.at("version") != 1) throw Error("not version 1 of a stroke");
    out.rate_Hz = json.at("rate_Hz").get<double>();
    out.high_pass_Hz = json.at("high_pass_Hz").get<double>();
    out.axes = json.at("axes").get<int>();
    out.contact_N = json.at("contact_N").get<double>();
    out.noise_mps2 = json.at("noise_mps2").get<double>();
    if (!(out.rate_Hz > 0.0 && out.rate_Hz < 1e9) || !(out.high_pass_Hz > 0.0 && out.high_pass_Hz < out.rate_Hz / 2.0))
      throw Error("its rate or its high-pass is out of range");
    if (json.at("samples") != out.size() || json.at("crc32") != crc32(text))
      throw Error("stroke.csv is not the one that was written with it");
    out.speed_is_measured = is_measured(json, "speed", !out.speed_mps.empty(), file);
    out.force_is_measured = is_measured(json, "force", !out.force_N.empty(), file);
  } catch (const Error& error) {
    const std::string message = error.what();
    throw Error(message.find(file) == std::string::npos ? file + ": " + message : message);
  }
  return out;
}

}  // namespace asperity
