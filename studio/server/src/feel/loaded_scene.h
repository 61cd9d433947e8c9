#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/progress.h"
#include "feel/feel_devices.h"
#include "feel/feel_setup.h"

namespace asperity::studio {

// What is rendered and shown, as the choices say. Immutable, and kept until a newer one is whole.
struct LoadedScene {
  FeelSetup setup;
  std::string source;                    // what of the choices the scene was read from
  std::string stamp;                     // of all files that were read: another one if any has changed
  std::shared_ptr<const Scene> scene;    // as it was read
  BlockWriter block{"feel.scene"};       // as it is drawn
  std::size_t content = 0;               // a hash of the block
  std::uint64_t drawn = 0;               // number of the first world that is drawn like this one
  std::uint64_t number = 0;              // of this world
  std::vector<std::string_view> models;  // how each texture becomes a force
  std::string title;
};

// Reads the scene, unless `before` was read from the same, and makes its block. Not for the studio's thread. Throws
// Error in words for what cannot be read or rendered.
std::shared_ptr<const LoadedScene> load_scene(FeelSetup setup, const FeelChoices& choices,
                                              const std::shared_ptr<const LoadedScene>& before, std::uint64_t number,
                                              const Observer& observer);

// The model of a world for a device that runs already, within what it can render. Not for the studio's thread.
PreparedModel prepare_swapped_model(const LoadedScene& world, const DeviceInfo& device, bool as_it_is,
                                    const FeelConfig& running);

}  // namespace asperity::studio
