#include <cmath>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/texture/texture_file.h"

namespace asperity {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, const char* key) {
  if (!std::isfinite(value))
    throw Error(std::string("texture: '") + key + "' is " + number_text(value) + ", which a file cannot hold");
  return number_text(value);
}

std::string text(const std::string& value, const char* key) {
  if (!is_utf8(value)) throw Error(std::string("texture: '") + key + "' is not UTF-8 text: " + printable(value));
  return Json(value).dump();
}

std::string numbers(const std::vector<double>& values, const char* key) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += ", ";
    out += number(values[i], key);
  }
  return out + "]";
}

// One line, whatever layout the text had.
std::string json(const std::string& value, const char* key) {
  const Json parsed = Json::parse(value, nullptr, false);
  if (parsed.is_discarded()) throw Error(std::string("texture: '") + key + "' is not JSON: " + printable(value));
  return parsed.dump();
}

std::string fourier1d_text(const Fourier1d& f) {
  if (f.a_m.size() != f.b_m.size() || f.a_m.empty()) {
    throw Error("texture: " + std::to_string(f.a_m.size()) + " cosine and " + std::to_string(f.b_m.size()) +
                " sine coefficients");
  }
  return "{\n    \"length_mm\": " + number(f.length_mm, "length_mm") +
         ",\n    \"omega_rad_per_mm\": " + number(f.omega_rad_per_mm(), "omega_rad_per_mm") +
         ",\n    \"a_m\": " + numbers(f.a_m, "a_m") + ",\n    \"b_m\": " + numbers(f.b_m, "b_m") +
         ",\n    \"mean_m\": " + number(f.mean_m, "mean_m") + "\n  }";
}

}  // namespace

std::string format_texture(const Texture& t) {
  std::string out = "{\n  \"format\": \"asperity-texture\",\n  \"version\": 1";
  const auto add = [&](const char* key, const std::string& value) {
    out += std::string(",\n  \"") + key + "\": " + value;
  };
  const auto add_number = [&](const char* key, const std::optional<double>& value) {
    if (value) add(key, number(*value, key));
  };
  add("name", text(t.name, "name"));
  add("model", "\"fourier1d\"");
  add("fourier1d", fourier1d_text(t.fourier1d));
  add_number("compliance_kc", t.compliance_kc);
  add_number("stiffness_N_per_m", t.stiffness_N_per_m);
  add_number("friction", t.friction);
  add_number("lift_m", t.lift_m);
  if (!t.roughness.empty()) {
    std::string values;
    for (const auto& [key, value] : t.roughness)
      values += (values.empty() ? "" : ", ") + text(key, "roughness") + ": " + number(value, key.c_str());
    add("roughness", "{" + values + "}");
  }
  if (t.band_cycles_per_mm)
    add("band_cycles_per_mm",
        numbers({t.band_cycles_per_mm->begin(), t.band_cycles_per_mm->end()}, "band_cycles_per_mm"));
  std::string source = "{\"recording\": " + text(t.source.recording, "source.recording");
  if (!t.source.config_json.empty()) source += ", \"config\": " + json(t.source.config_json, "source.config");
  add("source", source + ", \"version\": " + text(t.source.version, "source.version") + "}");
  add("extra", json(t.extra_json, "extra"));
  return out + "\n}\n";
}

void write_texture(const std::filesystem::path& path, const Texture& texture) {
  write_file(path, format_texture(texture));
}

}  // namespace asperity
