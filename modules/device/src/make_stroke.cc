#include "asperity/device/make_stroke.h"

#include <cmath>

#include "check_config.h"
#include "unit_vector.h"

namespace asperity {

HandPath make_stroke(const HandStrokeConfig& config) {
  check_config("stroke", config);
  const Eigen::Vector3d along = unit_vector(config.direction, "stroke.direction");
  const Eigen::Vector3d start_m(config.start_m[0], config.start_m[1], config.start_m[2]);
  const Eigen::Vector3d end_m = start_m + config.length_m * along;
  const auto ns = [](double t_s) { return static_cast<std::int64_t>(std::llround(t_s * 1e9)); };
  const std::int64_t pressed_ns = ns(config.ramp_s);
  const std::int64_t leaves_ns = pressed_ns + ns(config.rest_s);
  const std::int64_t arrives_ns = leaves_ns + ns(config.length_m / config.speed_mps);
  const std::int64_t lifts_ns = arrives_ns + ns(config.rest_s);
  return {{0, start_m, 0.0},
          {pressed_ns, start_m, config.press_N},
          {leaves_ns, start_m, config.press_N},
          {arrives_ns, end_m, config.press_N},
          {lifts_ns, end_m, config.press_N},
          {lifts_ns + ns(config.ramp_s), end_m, 0.0}};
}

}  // namespace asperity
