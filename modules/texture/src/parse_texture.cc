#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/texture_file.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 16ULL << 20;
constexpr std::uint64_t kLargestPayload_bytes = 256ULL << 20;
constexpr std::size_t kMostRoughnessValues = 100;

using Json = LocatedJson::Json;

std::optional<double> optional_value(const LocatedJson& json, const char* key, double low, double high) {
  const Json* value = json.find("", key);
  if (!value) return std::nullopt;
  return read_number(json, *value, key, low, high);
}

std::string optional_text(const LocatedJson& json, const std::string& path, const char* key) {
  const Json* value = json.find(path, key);
  return value ? read_text(json, *value, path.empty() ? key : path + "." + key) : std::string();
}

// Reads the block of the model that is called as its key.
void read_model(const BlockInput& input, TextureModel& model) {
  for_each_texture_model([&]<class Model>() {
    using Traits = TextureModelTraits<Model>;
    if (input.path == Traits::kName) Traits::read_block(input, model.emplace<Model>());
  });
}

void parse_model(const LocatedJson& json, const PayloadReader& payload, Texture& texture) {
  const std::string model = required_text(json, "", "model");
  std::string known;
  for (const auto name : kTextureModelNames) {
    if (model == name) {
      json.require("", model.c_str());
      return read_model({json, model, payload}, texture.model);
    }
    known.append(known.empty() ? "" : ", ").append(name);
  }
  json.fail("model", "'" + printable(model) + "' is not a model that this version knows (" + known + ")");
}

void parse_common(const LocatedJson& json, Texture& texture) {
  texture.name = optional_text(json, "", "name");
  texture.compliance_kc = optional_value(json, "compliance_kc", 0.0, 1.0);
  texture.stiffness_N_per_m = optional_value(json, "stiffness_N_per_m", 0.0, 1e9);
  texture.friction = optional_value(json, "friction", 0.0, 100.0);
  texture.lift_m = optional_value(json, "lift_m", -1e6, 1e6);
  if (const Json* roughness = json.find("", "roughness")) {
    if (!roughness->is_object()) json.fail("roughness", "is not an object");
    if (roughness->size() > kMostRoughnessValues)
      json.fail("roughness", "has more than " + std::to_string(kMostRoughnessValues) + " values");
    for (const auto& [key, value] : roughness->items()) {
      texture.roughness[key] = read_number(json, value, "roughness." + key, -kLargestNumber, kLargestNumber);
    }
  }
  if (const Json* band = json.find("", "band_cycles_per_mm")) {
    const auto limits = read_numbers(json, *band, "band_cycles_per_mm", kLargestNumber);
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

std::string BlockInput::read_payload(const char* ending) const {
  const std::string file = required_text(json, path, "file");
  const bool plain = !file.empty() && file.front() != '.' && file.find_first_of("/\\:") == std::string::npos &&
                     file.find('\0') == std::string::npos;
  if (!plain || !file.ends_with(ending)) {
    json.fail(path + ".file",
              "'" + printable(file) + "' is not the plain name of a file *" + ending + " in the same folder");
  }
  if (!payload) json.fail(path + ".file", "'" + printable(file) + "' cannot be read from text alone");
  return payload(file);
}

Texture parse_texture(std::string_view content, const std::string& name, const PayloadReader& payload) {
  const LocatedJson json(content, name);
  const Json& format = json.require("", "format");
  if (format != "asperity-texture") json.fail("format", "is not \"asperity-texture\"");
  const Json& version = json.require("", "version");
  if (version != 1) json.fail("version", printable(version.dump()) + " is not a version that this program reads (1)");
  Texture texture;
  parse_model(json, payload, texture);
  json.only("", {"format", "version", "name", "model", texture.model_name(), "compliance_kc", "stiffness_N_per_m",
                 "friction", "lift_m", "roughness", "band_cycles_per_mm", "source", "extra"});
  parse_common(json, texture);
  return texture;
}

Texture read_texture(const std::filesystem::path& path, const std::function<void(std::string_view)>& seen) {
  const auto read = [&](const std::filesystem::path& file, std::uint64_t limit_bytes) {
    std::string content = read_file(file, limit_bytes);
    if (seen) seen(content);
    return content;
  };
  const PayloadReader payload = [&](const std::string& file) {
    const auto payload_path = path.parent_path() / file;
    // A link could lead out of the folder.
    if (std::filesystem::is_symlink(payload_path)) throw Error(payload_path.string() + ": is a symbolic link");
    return read(payload_path, kLargestPayload_bytes);
  };
  return parse_texture(read(path, kLargestFile_bytes), path.string(), payload);
}

}  // namespace asperity
