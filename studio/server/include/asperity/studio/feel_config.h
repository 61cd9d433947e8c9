#pragma once

#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/device/pointer_device.h"
#include "asperity/session/feel_settings.h"

namespace asperity::studio {

// With what the Feel page starts: the settings of `asperity feel`, and those of the pointer. From the command line and
// the user's config alone.
struct FeelConfig {
  FeelSettings feel;
  PointerDeviceConfig pointer;

  FeelConfig() { feel.servo.paced = true; }
};

// All of them, for --config, --set and --print-config.
inline std::vector<ConfigField> feel_config_fields(FeelConfig& config) {
  std::vector<ConfigField> out = feel_fields(config.feel);
  for (ConfigField& field : list_fields("pointer", config.pointer)) out.push_back(std::move(field));
  return out;
}

}  // namespace asperity::studio
