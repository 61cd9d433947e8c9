#pragma once

#include "asperity/render/device_state.h"
#include "asperity/render/render_model.h"
#include "asperity/render/servo_output.h"
#include "asperity/render/servo_state.h"

namespace asperity {

// One step of the servo loop: moves the proxy as far towards the device as the objects and friction let it, and
// renders f = f_c + f_t + f_f (thesis §6.5 (3)–(6), B.3, errata 19–21). The same model, states and inputs give the
// same bits. The force is zero if an input is not finite.
// Realtime-safe: yes. Thread-safe: yes, for different states.
ServoOutput render_step(const RenderModel& model, ServoState& state, const DeviceState& device) noexcept;

}  // namespace asperity
