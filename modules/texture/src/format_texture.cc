#include <algorithm>
#include <utility>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/texture/texture_file.h"
#include "model_block.h"

namespace asperity {
namespace {

Json whole_extra(const Texture& texture) {
  if (!texture.extra.is_object()) throw Error("texture: extra is not an object: " + shown(texture.extra));
  if (!texture.fit) return texture.extra;
  Json out = Json::object();
  const std::vector<JsonMember>& others = texture.extra.items();
  for (std::size_t i = 0; i <= others.size(); ++i) {
    if (i == std::min(texture.fit->place, others.size())) out[kFitKey] = texture.fit->metrics;
    if (i < others.size()) out[others[i].key] = others[i].value;
  }
  return out;
}

}  // namespace

std::string BlockOutput::add_payload(const char* ending, std::string content) {
  payloads.push_back({stem + ending, std::move(content)});
  return payloads.back().file;
}

TextureFiles format_texture_files(const Texture& t, const std::string& stem) {
  BlockOutput output{stem, {}};
  JsonWriter out(kTextureStyle);
  const auto add_number = [&](const char* key, const std::optional<double>& value) {
    if (value) out.number(key, *value);
  };
  out.text("format", "asperity-texture");
  out.integer("version", 1);
  out.text("name", t.name);
  const std::string model(t.model_name());
  out.text("model", model);
  out.raw(model,
          std::visit([&]<class Model>(const Model& m) { return TextureModelTraits<Model>::write_block(m, output); },
                     t.model));
  add_number("compliance_kc", t.compliance_kc);
  add_number("stiffness_N_per_m", t.stiffness_N_per_m);
  add_number("friction", t.friction);
  add_number("static_friction_ratio", t.static_friction_ratio);
  add_number("lift_m", t.height_offset_m);
  add_number("height_sigma_m", t.height_sigma_m);
  if (!t.roughness.empty()) {
    out.begin_inline("roughness");
    for (const auto& [key, value] : t.roughness) out.number(key, value);
    out.end_object();
  }
  if (t.band_cycles_per_mm)
    out.numbers("band_cycles_per_mm", t.band_cycles_per_mm->data(), t.band_cycles_per_mm->size());
  out.begin_inline("source");
  out.text("recording", t.source.recording);
  if (t.source.config) out.raw("config", t.source.config->dump());
  out.text("version", t.source.version);
  if (t.source.snr) out.number("snr", *t.source.snr);
  out.end_object();
  out.raw("extra", whole_extra(t).dump());
  return {out.finish(), std::move(output.payloads)};
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
