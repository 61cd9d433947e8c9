#include "asperity/session/rendered_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/fidelity/press_in_scan.h"
#include "asperity/fidelity/stroke_signals.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/scene/read_scene.h"
#include "asperity/session/register_input.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMadeFrom = "made_from";
constexpr std::uint64_t kLargestProfile_bytes = 512ULL << 20;

// The last part of a path, that of "rec/" included.
std::string last_part(const fs::path& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string();
}

std::string text_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json.at(key).is_string() ? json.at(key).get<std::string>() : "";
}

void read_profile(const fs::path& file, RenderedInput& out) {
  const std::string text = read_file(file, kLargestProfile_bytes);
  CsvReader table(text, printable(file.string(), 200));
  const std::size_t s = table.require("s_m"), texture = table.require("texture_m");
  double first_m = 0.0, last_m = 0.0;
  while (table.next()) {
    last_m = table.finite(s);
    if (out.height_m.empty()) first_m = last_m;
    out.height_m.push_back(table.finite_or_nan(texture));
  }
  if (out.height_m.size() < 2 || !(last_m > first_m)) table.fail("fewer than two points, or s_m does not rise");
  out.spacing_m = (last_m - first_m) / static_cast<double>(out.height_m.size() - 1);
}

std::vector<StrokeSource> sources_of(const Scene& scene) {
  std::vector<StrokeSource> out;
  for (const SceneObject& object : scene.objects) {
    for (const SceneTexture& texture : object.textures) {
      if (texture.origin && texture.origin->is_scan())
        out.push_back({texture.origin->name, texture.origin->checksum, parse_fingerprint(texture.origin->fingerprint)});
      else
        for (StrokeSource& source : asperity::sources_of(texture.texture)) out.push_back(std::move(source));
    }
  }
  return out;
}

}  // namespace

void note_sources(Texture& texture, const std::vector<StrokeSource>& sources) {
  Json list = Json::array();
  for (const StrokeSource& source : sources) {
    Json one = {{"name", source.name}, {"checksum", source.checksum}};
    if (source.is_sketched()) one["fingerprint"] = fingerprint_json(source.fingerprint);
    list.push_back(std::move(one));
  }
  texture.extra[kMadeFrom] = list;
}

std::vector<StrokeSource> sources_of(const Texture& texture) {
  std::vector<StrokeSource> out;
  if (texture.extra.contains(kMadeFrom) && texture.extra.at(kMadeFrom).is_array()) {
    for (const Json& one : texture.extra.at(kMadeFrom)) {
      StrokeSource source{text_of(one, "name"), text_of(one, "checksum"), {}};
      if (one.is_object() && one.contains("fingerprint")) source.fingerprint = parse_fingerprint(one.at("fingerprint"));
      if (!source.name.empty() || !source.checksum.empty()) out.push_back(std::move(source));
    }
  }
  if (out.empty() && !texture.source.recording.empty()) out.push_back({texture.source.recording, "", {}});
  return out;
}

std::vector<StrokeSource> sources_of_input(const fs::path& path, const Observer& observer) {
  if (fs::is_directory(path)) return {source_of(path, read_recording(path, {}, observer), last_part(path))};
  if (path.filename().string().ends_with("texture.json")) return sources_of(read_texture(path, {}, observer));
  const fs::path folder = fs::absolute(path).parent_path();
  if (!fs::is_regular_file(folder / "result.json") || !fs::is_regular_file(folder / "texture.json")) return {};
  return sources_of(read_texture(folder / "texture.json", {}, observer));
}

RenderedInput read_rendered(const fs::path& path, const Observer& observer) {
  RenderedInput out;
  fs::path file = path;
  if (fs::is_directory(path)) {
    file = path / "scene.json";
    if (!fs::exists(file) && fs::exists(path / "profile.csv")) {
      if (!fs::exists(path / "texture.json"))
        throw Error(printable(path.string(), 200) +
                    ": is a result without texture.json, because its stroke was too short");
      out.texture = read_texture(path / "texture.json", {}, observer);
      read_profile(path / "profile.csv", out);
      out.sources = sources_of(out.texture);
      return out;
    }
    if (!fs::exists(file))
      throw Error(printable(path.string(), 200) + ": holds neither scene.json nor profile.csv with texture.json");
  }
  const std::string name = file.filename().string();
  if (name.ends_with("texture.json")) {
    out.texture = read_texture(file, {}, observer);
    out.sources = sources_of(out.texture);
  } else {
    out.scene = read_scene(file, observer);
    out.sources = sources_of(*out.scene);
  }
  return out;
}

bool is_among(const std::vector<StrokeSource>& sources, const StrokeSource& recording) {
  return std::any_of(sources.begin(), sources.end(), [&](const StrokeSource& source) {
    if (is_same_measurement(source.fingerprint, recording.fingerprint)) return true;
    return source.checksum.empty() || recording.checksum.empty() ? source.name == recording.name
                                                                 : source.checksum == recording.checksum;
  });
}

StrokeSource source_of(const fs::path& folder, const Recording& recording, const std::string& name) {
  return {name, recording_checksum(folder), fingerprint_of(recording)};
}

RealStroke measure_real_stroke(const fs::path& folder, const Recording& recording, const RenderedInput& rendered,
                               const ProcessConfig& config, const Observer& observer) {
  ProcessConfig as_measured = config;
  as_measured.profile.remove_noise = false;
  as_measured.profile.merge_passes = false;
  RealStroke out;
  out.name = last_part(folder);
  out.calibration = recording.calibration;
  try {
    out.result = rendered.scene ? measure_on_scene(recording, *rendered.scene, as_measured, observer)
                                : process_recording(recording, as_measured, observer);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(printable(folder.string(), 200) + ": " + error.what());
  }
  if (out.result.profile.size() == 0) throw Error(printable(folder.string(), 200) + ": " + out.result.verdict);
  return out;
}

RenderedRelief relief_under(const RenderedInput& rendered, const RealStroke& stroke, const RenderConfig& otherwise) {
  const Profile& profile = stroke.result.profile;
  if (rendered.scene) {
    return relief_of_scene(*rendered.scene, stroke.result,
                           measure_stroke(stroke.result, stroke.calibration, stroke.name), grid_of(profile), otherwise);
  }
  if (rendered.height_m.empty()) {
    return relief_of_texture(rendered.texture, profile.spacing_m,
                             profile.spacing_m * static_cast<double>(profile.size()), otherwise);
  }
  if (!(std::abs(rendered.spacing_m - profile.spacing_m) <= 1e-6 * profile.spacing_m)) {
    throw Error("the rendered profile's points are " + number_text(1e6 * rendered.spacing_m) +
                " µm apart, the stroke's " + number_text(1e6 * profile.spacing_m) + " µm (profile.spacing_m)");
  }
  return relief_of_heights(rendered.height_m, profile.spacing_m, rendered.texture, otherwise);
}

}  // namespace asperity
