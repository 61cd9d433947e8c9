#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/progress.h"
#include "asperity/session/feel_scene.h"
#include "asperity/studio/feel_config.h"
#include "asperity/studio/project.h"
#include "feel/feel_choices.h"
#include "setup/project_setup.h"

namespace asperity::studio {

// The settings that a browser may change: how the scene is rendered, the modelled hand, the pointer, how loud. None of
// the safety layer's, of what a device can bear, of ports, hosts, paths or drivers: those are the command line's.
std::vector<ConfigField> settable_fields(FeelConfig& config);

// True for a setting that a running scene takes while it is touched; the others wait for the next start.
bool is_live(std::string_view path);

// What a user chose, with files found and settings applied to those of the start.
struct FeelSetup {
  FeelConfig config;
  SceneInput input;
  MeshReading reading;  // of a mesh given alone
  std::map<int, std::filesystem::path> textures;
  std::string device;
  std::string replay;
  bool mapped = false;
};

// Throws Error naming a file that is not in the project, a setting that a browser may not change or a value that it
// does not take, an unknown device.
FeelSetup resolve_choices(const FeelChoices& choices, const FeelConfig& start, const Project& project,
                          const ProjectSetup& project_setup = {});

// Reads the scene, with other textures instead of its own where the user chose so. Not for the studio's
// thread. Throws Error naming the file.
Scene read_chosen_scene(FeelSetup& setup, const Observer& observer);

}  // namespace asperity::studio
