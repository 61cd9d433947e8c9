#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/texture/texture_file.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {
namespace {

using Json = nlohmann::ordered_json;

// One line, whatever layout the text had.
std::string json(const std::string& value, const char* key) {
  const Json parsed = Json::parse(value, nullptr, false);
  if (parsed.is_discarded()) throw Error(std::string("texture: '") + key + "' is not JSON: " + printable(value));
  return parsed.dump();
}

}  // namespace

std::string BlockOutput::add_payload(const char* ending, std::string content) {
  payloads.push_back({stem + ending, std::move(content)});
  return payloads.back().file;
}

TextureFiles format_texture_files(const Texture& t, const std::string& stem) {
  BlockOutput output{stem, {}};
  std::string out = "{\n  \"format\": \"asperity-texture\",\n  \"version\": 1";
  const auto add = [&](const char* key, const std::string& value) {
    out += std::string(",\n  \"") + key + "\": " + value;
  };
  const auto add_number = [&](const char* key, const std::optional<double>& value) {
    if (value) add(key, number_json(*value, key));
  };
  add("name", text_json(t.name, "name"));
  const std::string model(t.model_name());
  add("model", "\"" + model + "\"");
  add(model.c_str(),
      std::visit([&]<class Model>(const Model& m) { return TextureModelTraits<Model>::write_block(m, output); },
                 t.model));
  add_number("compliance_kc", t.compliance_kc);
  add_number("stiffness_N_per_m", t.stiffness_N_per_m);
  add_number("friction", t.friction);
  add_number("lift_m", t.lift_m);
  if (!t.roughness.empty()) {
    std::string values;
    for (const auto& [key, value] : t.roughness)
      values += (values.empty() ? "" : ", ") + text_json(key, "roughness") + ": " + number_json(value, key.c_str());
    add("roughness", "{" + values + "}");
  }
  if (t.band_cycles_per_mm)
    add("band_cycles_per_mm",
        numbers_json({t.band_cycles_per_mm->begin(), t.band_cycles_per_mm->end()}, "band_cycles_per_mm"));
  std::string source = "{\"recording\": " + text_json(t.source.recording, "source.recording");
  if (!t.source.config_json.empty()) source += ", \"config\": " + json(t.source.config_json, "source.config");
  add("source", source + ", \"version\": " + text_json(t.source.version, "source.version") + "}");
  add("extra", json(t.extra_json, "extra"));
  return {out + "\n}\n", std::move(output.payloads)};
}

std::string format_texture(const Texture& texture) { return format_texture_files(texture, "texture").json; }

std::string texture_stem(const std::filesystem::path& path) {
  std::string stem = path.filename().string();
  for (const char* ending : {".json", ".texture"}) {
    if (stem.ends_with(ending)) stem.resize(stem.size() - std::string_view(ending).size());
  }
  return stem.empty() || stem.front() == '.' ? "texture" : stem;
}

void write_texture(const std::filesystem::path& path, const Texture& texture) {
  const TextureFiles files = format_texture_files(texture, texture_stem(path));
  for (const auto& payload : files.payloads) write_file(path.parent_path() / payload.file, payload.content);
  write_file(path, files.json);
}

}  // namespace asperity
