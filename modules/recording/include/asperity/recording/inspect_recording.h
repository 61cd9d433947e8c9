#pragma once

#include <string>

#include "asperity/json/json.h"
#include "asperity/recording/inspection.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct InspectConfig {
  double quiet_s = 0.4;
  double rest_acceleration_mps2 = 0.5;
  double rest_position_m = 0.001;
  double flip_angle_rad = 0.5;
  double flip_distance_m = 0.05;
  double rate_tolerance = 0.1;
  double lost_tolerance = 0.01;
  double gap_tolerance_s = 0.1;
  double saturation_tolerance = 0.001;
  double gravity_tolerance = 0.03;
  double gravity_angle_tolerance_rad = 0.1;

  template <class V>
  void visit(V& v) {
    v.field("quiet_s", quiet_s, "length of the stretch in which the probe is stationary, s", {0.01, 60.0});
    v.field("rest_acceleration_mps2", rest_acceleration_mps2,
            "standard deviation of the acceleration while stationary, at most, m/s^2", {0.0, 100.0});
    v.field("rest_position_m", rest_position_m, "standard deviation of the position while stationary, at most, m",
            {0.0, 1.0});
    v.field("flip_angle_rad", flip_angle_rad, "rotation from frame to frame that no hand makes, rad", {0.0, 3.15});
    v.field("flip_distance_m", flip_distance_m, "a step from frame to frame that no hand makes, m", {0.0, 10.0});
    v.field("rate_tolerance", rate_tolerance, "deviation from the nominal rate to report, share", {0.0, 1.0});
    v.field("lost_tolerance", lost_tolerance, "lost rows to report, share", {0.0, 1.0});
    v.field("gap_tolerance_s", gap_tolerance_s, "gap to report, s", {0.0, 3600.0});
    v.field("saturation_tolerance", saturation_tolerance, "saturated samples to report, share", {0.0, 1.0});
    v.field("gravity_tolerance", gravity_tolerance, "deviation from gravity while stationary to report, share",
            {0.0, 1.0});
    v.field("gravity_angle_tolerance_rad", gravity_angle_tolerance_rad,
            "angle to gravity while stationary to report, rad", {0.0, 3.15});
  }
};

// Rates, gaps, losses, saturation, static noise, and suspicious values. The recording must keep the
// rules of validate_recording, as read_recording returns it. Linear in the number of rows.
Inspection inspect_recording(const Recording& recording, const InspectConfig& config = {});

// The inspection as an object (units in the key names, null for nan), and as lines for a person.
Json inspection_json(const Inspection& inspection);
std::string inspection_text(const Inspection& inspection);

}  // namespace asperity
