#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "asperity/device/servo_tick.h"

namespace asperity {

// Ticks as CSV, one a line, everything in SI and, where not said otherwise, in the scene's world:
// t_ns, the reading (status, sequence, buttons, position and velocity in the device's axes), the device point, the
// proxy, the rendered force and its parts, the touched object and triangle, what the safety layer let through and why
// it changed it (cause_names), late_ns and step_ns. The same ticks give the same bytes.
std::string format_flight_record(std::span<const ServoTick> ticks);

// Writes that to `path`, as a whole or not at all. Throws Error naming it.
void write_flight_record(const std::filesystem::path& path, std::span<const ServoTick> ticks);

}  // namespace asperity
