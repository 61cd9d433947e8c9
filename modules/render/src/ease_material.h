#pragma once

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"

namespace asperity {

// Begins a step of `dt_s`. Where the model's materials are others than in the step before and something was touched
// then, what was felt begins to ease towards the new over the textures' cross_fade_s. Without touch nothing eases.
// Realtime-safe: yes.
void ease_material(const RenderModel& model, double dt_s, EasedMaterial& eased) noexcept;

}  // namespace asperity
