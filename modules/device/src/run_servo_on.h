#pragma once

#include <cstdint>

#include "asperity/device/servo_loop.h"

namespace asperity {

// A clock that goes on while the machine is suspended.
using BootClock = std::int64_t (*)() noexcept;

// run_servo (servo_loop.h) by another such clock than the machine's: for tests.
ServoResult run_servo_on(BootClock boot_now, HapticDevice& device, SnapshotExchange<const RenderModel>& scene,
                         const ServoConfig& config, const std::atomic<bool>& stop,
                         const std::function<void(const ServoTick&)>& on_tick, ServoStep step = &render_step,
                         const ForcePermit* permit = nullptr);

}  // namespace asperity
