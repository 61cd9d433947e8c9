#pragma once

#include <cstdint>
#include <memory>

#include <asperity_feel.h>
#include "asperity/device/rumble_bands.h"
#include "asperity/device/snapshot_exchange.h"
#include "asperity/device/vibration_axis.h"
#include "asperity/render/render_model.h"
#include "asperity/render/servo_state.h"
#include "asperity/scene/scene.h"

// What is behind the handles of asperity_feel.h.

struct asperity_scene {
  asperity::Scene scene;
};

struct asperity_settings {
  asperity::RenderConfig render;
};

struct asperity_feel {
  explicit asperity_feel(std::unique_ptr<const asperity::RenderModel> first) : model(std::move(first)) {}

  asperity::SnapshotExchange<const asperity::RenderModel> model;
  asperity::ServoState state;
  asperity::VibrationAxis vibration;
  std::int64_t t_ns = 0;
};

struct asperity_rumble {
  asperity::RumbleBands bands;
  double full_scale_N;
  bool running;  // false after a reset: the filters begin settled at the next force
};
