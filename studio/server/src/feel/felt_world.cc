#include "feel/felt_world.h"

#include <utility>

#include "feel/scene_block.h"

namespace asperity::studio {

namespace {

// Images become a scene with the settings' stiffness and model in it, and are small: they are read each time.
bool same_source(const FeelSetup& setup, const std::string& source, const std::shared_ptr<const FeltWorld>& before) {
  return before && setup.input.height_maps.empty() && before->source == source;
}

std::string source_of(const FeelSetup& setup) {
  std::string out = setup.input.scene + '\n' + setup.input.mesh_unit;
  for (const auto& [index, file] : setup.textures) out += '\n' + std::to_string(index) + ' ' + file.string();
  return out;
}

std::string title_of(const FeelChoices& choices) {
  if (choices.height_maps.empty()) return choices.scene;
  return std::to_string(choices.height_maps.size()) +
         (choices.height_maps.size() == 1 ? " height map" : " height maps");
}

}  // namespace

std::shared_ptr<const FeltWorld> make_felt_world(FeelSetup setup, const FeelChoices& choices,
                                                 const std::shared_ptr<const FeltWorld>& before,
                                                 std::uint64_t revision) {
  auto out = std::make_shared<FeltWorld>();
  out->source = source_of(setup);
  if (same_source(setup, out->source, before)) {
    out->scene = before->scene;
  } else {
    out->scene = std::make_shared<const Scene>(read_chosen_scene(setup));
  }
  out->block = make_scene_block(*out->scene, make_render_model(*out->scene, setup.config.feel.render_config()));
  out->setup = std::move(setup);
  out->revision = revision;
  out->title = title_of(choices);
  out->block.head()["revision"] = revision;
  out->block.head()["title"] = out->title;
  out->block.head()["height_maps"] = !choices.height_maps.empty();
  return out;
}

app::FeltModel make_swapped_model(const FeltWorld& world, const DeviceInfo& device, bool as_it_is,
                                  const FeelConfig& running) {
  app::FeelSettings settings = world.setup.config.feel;
  // Where the device stands, how fast it is served and how safely is settled for the run.
  settings.servo = running.feel.servo;
  return app::make_felt_model(*world.scene, device, as_it_is, settings);
}

}  // namespace asperity::studio
