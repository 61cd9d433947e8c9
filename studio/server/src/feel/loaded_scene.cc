#include "feel/loaded_scene.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "asperity/base/text.h"
#include "feel/scene_block.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

// Size and time of a file and of those next to it that belong to it: of wood.texture.json also wood.heights.png.
void stamp_family(const fs::path& file, std::string& out) {
  const std::string name = file.filename().string();
  const std::string stem = name.substr(0, name.find('.'));
  std::vector<std::string> lines;
  std::error_code error;
  for (fs::directory_iterator at(file.parent_path(), error), end; !error && at != end; at.increment(error)) {
    const std::string other = at->path().filename().string();
    if (other.substr(0, other.find('.')) != stem) continue;
    std::error_code gone;
    const auto written = at->last_write_time(gone);
    const auto size = at->file_size(gone);
    lines.push_back(other + ' ' + std::to_string(written.time_since_epoch().count()) + ' ' + std::to_string(size));
  }
  std::sort(lines.begin(), lines.end());
  for (const std::string& line : lines) out += line + '\n';
}

std::string stamp_of(const FeelSetup& setup, const Scene& scene) {
  fs::path file(setup.input.scene);
  if (fs::is_directory(file)) file /= "scene.json";
  std::string out;
  stamp_family(file, out);
  for (const SceneObject& object : scene.objects) {
    stamp_family(file.parent_path() / object.mesh_file, out);
    if (!object.material_file.empty()) stamp_family(file.parent_path() / object.material_file, out);
    for (const SceneTexture& texture : object.textures) stamp_family(file.parent_path() / texture.file, out);
  }
  for (const auto& [index, texture] : setup.textures) stamp_family(texture, out);
  return out;
}

// Images become a scene with the settings' stiffness and model in it, and are small: they are read each time.
bool same_source(const FeelSetup& setup, const std::string& source, const std::shared_ptr<const LoadedScene>& before) {
  return before && setup.input.height_maps.empty() && before->source == source &&
         before->stamp == stamp_of(setup, *before->scene);
}

std::string source_of(const FeelSetup& setup) {
  std::string out = setup.input.scene + '\n' + number_text(setup.input.mesh_unit_m.value_or(0.0)) +
                    (setup.reading.from == MeshReading::From::kProject ? " assumed" : "");
  for (const auto& [index, file] : setup.textures) out += '\n' + std::to_string(index) + ' ' + file.string();
  return out;
}

std::string title_of(const FeelChoices& choices) {
  if (choices.height_maps.empty()) return choices.scene;
  return std::to_string(choices.height_maps.size()) +
         (choices.height_maps.size() == 1 ? " height map" : " height maps");
}

}  // namespace

std::shared_ptr<const LoadedScene> load_scene(FeelSetup setup, const FeelChoices& choices,
                                              const std::shared_ptr<const LoadedScene>& before, std::uint64_t number,
                                              const Observer& observer) {
  auto out = std::make_shared<LoadedScene>();
  out->source = source_of(setup);
  if (same_source(setup, out->source, before)) {
    out->scene = before->scene;
    out->stamp = before->stamp;
  } else {
    out->scene = std::make_shared<const Scene>(read_chosen_scene(setup, observer));
    if (setup.input.height_maps.empty()) out->stamp = stamp_of(setup, *out->scene);
  }
  const RenderModel model = make_render_model(*out->scene, setup.config.feel.render_config());
  out->block = make_scene_block(*out->scene, model);
  for (const RenderTexture& texture : model.textures) out->models.push_back(name_of(texture.model));
  out->setup = std::move(setup);
  out->title = title_of(choices);
  out->block.head()["title"] = out->title;
  out->block.head()["height_maps"] = !choices.height_maps.empty();
  BlockWriter copy = out->block;
  out->content = std::hash<std::string>()(copy.take());
  // A change of the force alone needs no new drawing.
  out->number = number;
  out->drawn = before && before->content == out->content ? before->drawn : number;
  return out;
}

PreparedModel prepare_swapped_model(const LoadedScene& world, const DeviceInfo& device, bool as_it_is,
                                    const FeelConfig& running) {
  FeelSettings settings = world.setup.config.feel;
  // Position, rate and safety of the device are fixed for the run.
  settings.servo = running.feel.servo;
  return prepare_render_model(*world.scene, device, as_it_is, settings);
}

}  // namespace asperity::studio
