#include <cmath>
#include <limits>

#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/texture/texture_file.h"
#include "located_json.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 16ULL << 20;
constexpr std::size_t kMostCoefficients = 65536;
constexpr std::size_t kLongestText_bytes = 4096;
constexpr std::size_t kMostRoughnessValues = 100;
constexpr double kMax = std::numeric_limits<double>::max();
// Larger heights are a mistake of unit, and their sums could overflow.
constexpr double kLargestHeight_m = 1e3;

using Json = LocatedJson::Json;

double number(const LocatedJson& json, const Json& value, const std::string& path, double low, double high) {
  if (!value.is_number()) json.fail(path, "is not a number");
  const double result = value.get<double>();
  if (!std::isfinite(result) || result < low || result > high) {
    json.fail(path, number_text(result) + " is not within " + number_text(low) + " and " + number_text(high));
  }
  return result;
}

std::optional<double> optional_number(const LocatedJson& json, const char* key, double low, double high) {
  const Json* value = json.find("", key);
  if (!value) return std::nullopt;
  return number(json, *value, key, low, high);
}

std::string text(const LocatedJson& json, const Json& value, const std::string& path) {
  if (!value.is_string()) json.fail(path, "is not a text");
  const auto& result = value.get_ref<const std::string&>();
  if (result.size() > kLongestText_bytes)
    json.fail(path, "is longer than " + std::to_string(kLongestText_bytes) + " bytes");
  return result;
}

std::string optional_text(const LocatedJson& json, const std::string& path, const char* key) {
  const Json* value = json.find(path, key);
  return value ? text(json, *value, path.empty() ? key : path + "." + key) : std::string();
}

std::vector<double> numbers(const LocatedJson& json, const Json& value, const std::string& path, double largest) {
  if (!value.is_array()) json.fail(path, "is not a list of numbers");
  if (value.size() > kMostCoefficients)
    json.fail(path, std::to_string(value.size()) + " numbers, more than " + std::to_string(kMostCoefficients));
  std::vector<double> result;
  result.reserve(value.size());
  for (const Json& element : value) {
    result.push_back(number(json, element, path + "[" + std::to_string(result.size()) + "]", -largest, largest));
  }
  return result;
}

Fourier1d parse_fourier1d(const LocatedJson& json) {
  const std::string path = "fourier1d";
  json.require("", "fourier1d");
  json.only(path, {"length_mm", "omega_rad_per_mm", "a_m", "b_m", "mean_m"});
  Fourier1d f;
  f.length_mm = number(json, json.require(path, "length_mm"), "fourier1d.length_mm", 1e-6, 1e6);
  if (const Json* omega = json.find(path, "omega_rad_per_mm")) {
    const double given = number(json, *omega, "fourier1d.omega_rad_per_mm", 0.0, kMax);
    if (std::abs(given - f.omega_rad_per_mm()) > 1e-4 * f.omega_rad_per_mm()) {
      json.fail("fourier1d.omega_rad_per_mm",
                number_text(given) + " is not 2π / length_mm = " + number_text(f.omega_rad_per_mm()));
    }
  }
  f.a_m = numbers(json, json.require(path, "a_m"), "fourier1d.a_m", kLargestHeight_m);
  f.b_m = numbers(json, json.require(path, "b_m"), "fourier1d.b_m", kLargestHeight_m);
  if (f.a_m.empty()) json.fail("fourier1d.a_m", "is empty");
  if (f.a_m.size() != f.b_m.size()) {
    json.fail("fourier1d.b_m", std::to_string(f.b_m.size()) + " numbers where a_m has " + std::to_string(f.a_m.size()));
  }
  if (const Json* mean = json.find(path, "mean_m"))
    f.mean_m = number(json, *mean, "fourier1d.mean_m", -kLargestHeight_m, kLargestHeight_m);
  return f;
}

void parse_model(const LocatedJson& json, Texture& texture) {
  const std::string model = text(json, json.require("", "model"), "model");
  if (model != "fourier1d")
    json.fail("model", "'" + printable(model) + "' is not a model that this version knows (fourier1d)");
  texture.fourier1d = parse_fourier1d(json);
}

void parse_common(const LocatedJson& json, Texture& texture) {
  texture.name = optional_text(json, "", "name");
  texture.compliance_kc = optional_number(json, "compliance_kc", 0.0, 1.0);
  texture.stiffness_N_per_m = optional_number(json, "stiffness_N_per_m", 0.0, 1e9);
  texture.friction = optional_number(json, "friction", 0.0, 100.0);
  texture.lift_m = optional_number(json, "lift_m", -1e6, 1e6);
  if (const Json* roughness = json.find("", "roughness")) {
    if (!roughness->is_object()) json.fail("roughness", "is not an object");
    if (roughness->size() > kMostRoughnessValues)
      json.fail("roughness", "has more than " + std::to_string(kMostRoughnessValues) + " values");
    for (const auto& [key, value] : roughness->items()) {
      texture.roughness[key] = number(json, value, "roughness." + key, -kMax, kMax);
    }
  }
  if (const Json* band = json.find("", "band_cycles_per_mm")) {
    const auto limits = numbers(json, *band, "band_cycles_per_mm", kMax);
    if (limits.size() != 2 || !(limits[0] >= 0.0) || !(limits[1] >= limits[0])) {
      json.fail("band_cycles_per_mm", "is not [low, high] with 0 <= low <= high");
    }
    texture.band_cycles_per_mm = {limits[0], limits[1]};
  }
  if (json.find("", "source")) {
    json.only("source", {"recording", "config", "version"});
    texture.source.recording = optional_text(json, "source", "recording");
    texture.source.version = optional_text(json, "source", "version");
    if (const Json* config = json.find("source", "config")) texture.source.config_json = config->dump();
  }
  if (const Json* extra = json.find("", "extra")) {
    if (!extra->is_object()) json.fail("extra", "is not an object");
    texture.extra_json = extra->dump();
  }
}

}  // namespace

Texture parse_texture(std::string_view content, const std::string& name) {
  const LocatedJson json(content, name);
  const Json& format = json.require("", "format");
  if (format != "asperity-texture") json.fail("format", "is not \"asperity-texture\"");
  const Json& version = json.require("", "version");
  if (version != 1) json.fail("version", printable(version.dump()) + " is not a version that this program reads (1)");
  Texture texture;
  parse_model(json, texture);
  json.only("", {"format", "version", "name", "model", "fourier1d", "compliance_kc", "stiffness_N_per_m", "friction",
                 "lift_m", "roughness", "band_cycles_per_mm", "source", "extra"});
  parse_common(json, texture);
  return texture;
}

Texture read_texture(const std::filesystem::path& path) {
  return parse_texture(read_file(path, kLargestFile_bytes), path.string());
}

}  // namespace asperity
