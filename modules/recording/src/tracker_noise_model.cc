#include "asperity/recording/tracker_noise_model.h"

namespace asperity {

namespace {

Json law_json(const NoiseLaw& law) {
  return {{"scale", law.scale},
          {"scale_stderr", law.scale_error},
          {"distance_power", law.power},
          {"tilt_power", law.tilt_power},
          {"tilt_power_stderr", law.tilt_power_error},
          {"measured_distance_power", law.measured_power},
          {"measured_distance_power_stderr", law.measured_power_error},
          {"chi_square", law.chi_square},
          {"degrees_of_freedom", law.degrees_of_freedom}};
}

}  // namespace

Json noise_model_json(const TrackerNoiseModel& model) {
  return {{"formula", "sigma = scale * (distance / 1 m)^distance_power * cos(tilt)^-tilt_power"},
          {"position_across_ray_m", law_json(model.across_m)},
          {"position_along_ray_m", law_json(model.along_m)},
          {"rotation_about_ray_rad", law_json(model.about_rad)},
          {"rotation_across_ray_rad", law_json(model.tilt_rad)},
          {"nearest_m", model.nearest_m},
          {"farthest_m", model.farthest_m},
          {"steepest_rad", model.steepest_rad}};
}

}  // namespace asperity
