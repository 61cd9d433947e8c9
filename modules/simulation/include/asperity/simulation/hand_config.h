#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace asperity {

enum class HandPathShape { kStraight, kCurved, kBackAndForth };
inline constexpr std::array<std::string_view, 3> kHandPathShapeNames = {"straight", "curved", "back_and_forth"};

enum class HandForce { kSteady, kRamp };
inline constexpr std::array<std::string_view, 2> kHandForceNames = {"steady", "ramp"};

// How the probe is moved. Root mean square values unless said otherwise; sources in docs/virtual-bench.md.
struct HandConfig {
  HandPathShape path = HandPathShape::kStraight;
  double length_m = 0.08;         // of one stroke
  double speed_mps = 0.025;       // mean, without the ramps
  double speed_variation = 0.12;  // relative
  double speed_ramp_s = 0.25;     // to start and to stop
  double rest_s = 0.5;            // before and after
  int pauses = 0;                 // static intervals in the stroke, evenly spread over the path
  double pause_s = 1.0;
  double curve_sagitta_m = 8e-3;  // curved
  int strokes = 3;                // back and forth
  double row_spacing_m = 2.5e-3;  // back and forth: between neighbouring strokes; 0: all on one line
  double lateral_wander_m = 0.1e-3;
  std::int64_t path_seed = 0;  // of the wander: strokes along one guide share it; 0: the simulation's

  HandForce force = HandForce::kSteady;
  double force_N = 0.8;          // steady: normal set-point
  double force_variation = 0.1;  // relative, slow
  double ramp_from_N = 0.3;      // ramp: light
  double ramp_to_N = 2.5;        // ramp: firm
  int lifts = 0;                 // times the probe is lifted off during the strokes
  double lift_height_m = 3e-3;
  double lift_s = 0.4;

  double normal_mass_kg = 0.04;
  double normal_stiffness_N_per_m = 300.0;
  double normal_damping_N_s_per_m = 4.0;
  double normal_adaptation_s = 0.25;  // in which the hand follows the height it meets
  double tangential_mass_kg = 0.08;
  double tangential_stiffness_N_per_m = 2500.0;
  double tangential_damping_N_s_per_m = 15.0;

  double tremor_low_Hz = 8.0;
  double tremor_high_Hz = 12.0;
  double tremor_lateral_m = 0.03e-3;
  double tremor_normal_m = 0.06e-3;  // of the hand; the tip's is what the contact leaves of it
  double tremor_along_m = 0.03e-3;
  double tremor_rotation_rad = 1.0e-3;               // about each axis
  std::array<double, 3> tilt_rad{0.30, 0.10, 0.12};  // mean rotation vector of the marker in the world
  double tilt_wander_rad = 0.035;
  double tilt_wander_Hz = 0.5;  // highest frequency of all slow variations of the orientation
  double follow_normal = 0.7;   // on a cylinder: part of the normal's rotation that the probe follows

  template <class V>
  void visit(V& v) {
    v.choice("path", path, kHandPathShapeNames, "shape of the path on the base shape");
    v.field("length_m", length_m, "length of one stroke, m", {1e-3, 10.0});
    v.field("speed_mps", speed_mps, "mean speed, m/s", {1e-3, 1.0});
    v.field("speed_variation", speed_variation, "slow relative variation of the speed", {0.0, 0.3});
    v.field("speed_ramp_s", speed_ramp_s, "time to start and to stop, s", {0.01, 10.0});
    v.field("rest_s", rest_s, "stationary time in contact before and after the stroke, s", {0.0, 60.0});
    v.field("pauses", pauses, "stationary pauses in contact during the stroke", {0, 1000});
    v.field("pause_s", pause_s, "length of such a pause, s", {0.0, 600.0});
    v.field("curve_sagitta_m", curve_sagitta_m, "curved: height of the arc over its chord, m", {0.0, 1.0});
    v.field("strokes", strokes, "back_and_forth: number of strokes", {1, 1000});
    v.field("row_spacing_m", row_spacing_m, "back_and_forth: distance of neighbouring strokes, 0 for one line, m",
            {0.0, 0.1});
    v.field("lateral_wander_m", lateral_wander_m, "slow deviation from the path across it, m", {0.0, 0.01});
    v.field("path_seed", path_seed, "of that deviation, the same in strokes along one guide; 0: the simulation's",
            {0.0, 9e15});
    v.choice("force", force, kHandForceNames, "normal set-point: steady, or a ramp from light to firm");
    v.field("force_N", force_N, "steady: normal set-point, N", {0.0, 50.0});
    v.field("force_variation", force_variation, "slow relative variation of the force", {0.0, 0.5});
    v.field("ramp_from_N", ramp_from_N, "ramp: force at the start, N", {0.0, 50.0});
    v.field("ramp_to_N", ramp_to_N, "ramp: force at the end, N", {0.0, 50.0});
    v.field("lifts", lifts, "times the probe is lifted off", {0, 1000});
    v.field("lift_height_m", lift_height_m, "height to which the probe is lifted, m", {0.0, 0.1});
    v.field("lift_s", lift_s, "duration of lifting, s", {0.05, 10.0});
    v.field("normal_mass_kg", normal_mass_kg, "effective mass along the normal, kg", {1e-3, 10.0});
    v.field("normal_stiffness_N_per_m", normal_stiffness_N_per_m, "hand's stiffness along the normal, N/m", {0.0, 1e5});
    v.field("normal_damping_N_s_per_m", normal_damping_N_s_per_m, "hand's damping along the normal, N s/m", {0.0, 1e4});
    v.former("normal_damping_Ns_per_m");
    v.field("normal_adaptation_s", normal_adaptation_s, "time in which the hand yields to the height it meets, s",
            {0.01, 100.0});
    v.field("tangential_mass_kg", tangential_mass_kg, "effective mass along the stroke, kg", {1e-3, 10.0});
    v.field("tangential_stiffness_N_per_m", tangential_stiffness_N_per_m, "hand's stiffness along the stroke, N/m",
            {1.0, 1e5});
    v.field("tangential_damping_N_s_per_m", tangential_damping_N_s_per_m, "hand's damping along the stroke, N s/m",
            {0.0, 1e4});
    v.former("tangential_damping_Ns_per_m");
    v.field("tremor_low_Hz", tremor_low_Hz, "tremor's band, lower end, Hz", {0.0, 50.0});
    v.field("tremor_high_Hz", tremor_high_Hz, "tremor's band, upper end, Hz", {0.0, 50.0});
    v.field("tremor_lateral_m", tremor_lateral_m, "tremor across the stroke, m rms", {0.0, 0.01});
    v.field("tremor_normal_m", tremor_normal_m, "hand's tremor along the normal, m rms", {0.0, 0.01});
    v.field("tremor_along_m", tremor_along_m, "hand's tremor along the stroke, m rms", {0.0, 0.01});
    v.field("tremor_rotation_rad", tremor_rotation_rad, "tremor in rotation about each axis, rad rms", {0.0, 0.1});
    v.field("tilt_rad", tilt_rad, "mean rotation vector from marker to world, rad", {-3.2, 3.2});
    v.field("tilt_wander_rad", tilt_wander_rad, "slow variation of the orientation about each axis, rad rms",
            {0.0, 0.5});
    v.field("tilt_wander_Hz", tilt_wander_Hz, "its highest frequency, Hz", {0.0, 5.0});
    v.field("follow_normal", follow_normal, "on a cylinder: part of the normal's rotation that the probe follows",
            {0.0, 1.0});
  }
};

}  // namespace asperity
