#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/random_wave.h"
#include "asperity/simulation/simulate_motion.h"
#include "asperity/simulation/simulate_recording.h"
#include "scan_case.h"

namespace bench {

namespace {

using asperity::Random;
using asperity::SimulationConfig;

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

template <class T>
const T& one_of(Random& random, const std::vector<T>& list) {
  return list[std::min(list.size() - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size())))];
}

// The surface's parameters, drawn. `fine` is a texture at the probes' limit, `smooth` is glass.
void draw_surface(SimulationConfig& config, const std::string& family, Random& random, ScanCase& out) {
  asperity::SimulatedSurfaceConfig& surface = config.surface;
  if (family == "sine") {
    surface.pitch_m = log_uniform(random, 0.6e-3, 6e-3);
    // No steeper than 0.35, or the tip leaves it at every crest.
    const double steepest_m = 0.35 * surface.pitch_m / (2.0 * std::numbers::pi);
    surface.amplitude_m = std::min(steepest_m, log_uniform(random, 4e-6, 0.2e-3));
    out.pitch_m = surface.pitch_m;
  } else if (family == "protoboard") {
    const double scale = random.uniform(0.8, 1.3);
    surface.pitch_m *= scale;
    surface.hole_diameter_m *= scale;
    surface.hole_opening_diameter_m *= scale;
    surface.hole_depth_m *= scale * random.uniform(0.2, 1.0);
    out.pitch_m = surface.pitch_m;
  } else if (family == "cable_tie") {
    surface.pitch_m = log_uniform(random, 0.7e-3, 2.5e-3);
    surface.tooth_height_m = surface.pitch_m * random.uniform(0.05, 0.33);
    surface.tooth_rise = random.uniform(0.4, 0.8);
    out.pitch_m = surface.pitch_m;
  } else {
    const bool smooth = family == "smooth";
    surface.rq_m = smooth             ? log_uniform(random, 0.05e-6, 0.4e-6)
                   : family == "fine" ? log_uniform(random, 1e-6, 8e-6)
                                      : log_uniform(random, 10e-6, 70e-6);
    surface.low_cycles_per_mm = log_uniform(random, 0.15, 0.6);
    surface.high_cycles_per_mm = log_uniform(random, 1.5, 4.0);
    surface.slope = random.uniform(-0.5, 2.0);
  }
}

void draw_hand(SimulationConfig& config, Random& random) {
  asperity::HandConfig& hand = config.hand;
  hand.speed_mps = log_uniform(random, 12e-3, 60e-3);
  hand.length_m = std::clamp(hand.speed_mps * random.uniform(2.5, 4.0), 0.04, 0.14);
  hand.speed_variation = random.uniform(0.04, 0.2);
  hand.rest_s = random.chance(0.15) ? random.uniform(2.0, 4.0) : random.uniform(0.3, 1.0);
  if (random.chance(0.35)) {
    hand.force = asperity::HandForce::kRamp;
    hand.ramp_from_N = random.uniform(0.3, 0.6);
    hand.ramp_to_N = random.uniform(1.2, 3.0);
  } else {
    hand.force_N = random.uniform(0.5, 1.6);
  }
  hand.tremor_normal_m *= random.uniform(0.5, 1.8);
  hand.tremor_along_m *= random.uniform(0.5, 1.8);
  hand.tremor_lateral_m *= random.uniform(0.5, 1.8);
  for (double& angle_rad : hand.tilt_rad) angle_rad += 0.06 * random.normal();
  if (random.chance(0.2)) hand.path = asperity::HandPathShape::kCurved;
}

// Strokes side by side, some 3 to 10 s in all. From numbers of its own: the scans that are no rasters stay as they
// were.
void draw_raster(SimulationConfig& config, std::uint64_t seed, CasePaths paths) {
  constexpr double kShare = 0.15;
  Random random(seed, 0x726173);
  if (!random.chance(kShare) && paths != CasePaths::kRaster) return;
  asperity::HandConfig& hand = config.hand;
  hand.path = asperity::HandPathShape::kBackAndForth;
  hand.strokes = 2 + static_cast<int>(7.0 * random.uniform());
  hand.row_spacing_m = log_uniform(random, 0.5e-3, 5e-3);
  hand.length_m = std::clamp(hand.speed_mps * random.uniform(3.0, 8.0) / hand.strokes, 0.012, 0.1);
}

void draw_faults(SimulationConfig& config, Random& random) {
  const double tracker_noise = log_uniform(random, 0.6, 1.8);
  for (double& sigma : config.tracker.noise_m) sigma *= tracker_noise;
  for (double& sigma : config.tracker.noise_rad) sigma *= tracker_noise;
  const double faults = random.chance(0.3) ? 0.0 : random.uniform(0.3, 2.0);
  config.tracker.flip_chance *= faults;
  config.tracker.dropout_chance *= faults;
  config.probe.spike_chance *= faults;
  config.probe.dropout_chance *= faults;
  if (config.probe.model == asperity::ProbeModel::kOpen && random.chance(0.3)) {
    config.probe.spike_chance = 5e-4;
    config.probe.dropout_chance = 5e-5;
  }
}

// Errors that are not white: static intervals in the stroke, clocks, drifting offsets, tracker drift, a shaking marker.
void draw_slow_errors(SimulationConfig& config, Random& random) {
  asperity::SimulatedProbeConfig& probe = config.probe;
  asperity::SimulatedTrackerConfig& tracker = config.tracker;
  if (random.chance(0.2)) {
    config.hand.pauses = 1 + static_cast<int>(2.0 * random.uniform());
    config.hand.pause_s = random.uniform(0.4, 1.5);
  }
  probe.clock_drift_ppm = 50.0 * random.normal();
  probe.clock_wander_s = log_uniform(random, 3e-6, 60e-6);
  if (probe.model == asperity::ProbeModel::kOpen && random.chance(0.3)) {
    probe.batch_samples = static_cast<int>(random.uniform(8.0, 40.0));
    probe.batch_delay_s = log_uniform(random, 0.1e-3, 0.5e-3);
  }
  const double accel_scale = probe.model == asperity::ProbeModel::kOpen ? 1.0 : 4.0;
  probe.accel_flicker_mps2 = accel_scale * log_uniform(random, 5e-4, 5e-3);
  probe.accel_warming_mps2 = accel_scale * log_uniform(random, 2e-3, 2e-2);
  probe.gyro_flicker_radps = log_uniform(random, 1e-4, 1e-3);
  tracker.clock_wander_s = log_uniform(random, 10e-6, 200e-6);
  tracker.slow_share = random.uniform(0.0, 0.5);
  tracker.slow_time_s = log_uniform(random, 0.3, 3.0);
  if (random.chance(0.25)) tracker.mount_Hz = random.uniform(60.0, 200.0);
}

// A probe waved in the air: smooth random motion of centimetres, no force but the sensor's noise.
asperity::Recording wave_in_the_air(const SimulationConfig& config, Random& random) {
  constexpr double kSeconds = 4.0;
  std::array<asperity::RandomWave, 3> place, turn;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place[axis] = asperity::RandomWave(random.uniform(2e-3, 20e-3), 0.1, 2.0, config.step_s, random);
    turn[axis] = asperity::RandomWave(random.uniform(0.01, 0.1), 0.1, 2.0, config.step_s, random);
  }
  const Eigen::Quaterniond mean_tilt = asperity::exp_rotation(Eigen::Vector3d(config.hand.tilt_rad.data()));
  asperity::Recording out = asperity::simulate_motion(
      config,
      [&](double) {
        asperity::MotionState state;
        Eigen::Vector3d turn_rad;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          state.p_world_tip_m[static_cast<Eigen::Index>(axis)] = config.shape.centre_m[axis] + place[axis].next();
          turn_rad[static_cast<Eigen::Index>(axis)] = turn[axis].next();
        }
        state.q_world_marker = mean_tilt * asperity::exp_rotation(turn_rad);
        return state;
      },
      kSeconds, "air");

  std::fill(out.truth->s_m.begin(), out.truth->s_m.end(), asperity::kNan);
  std::fill(out.truth->height_m.begin(), out.truth->height_m.end(), asperity::kNan);
  return out;
}

}  // namespace

const std::vector<std::string>& own_families() {
  static const std::vector<std::string> kFamilies{"sine",     "protoboard", "cable_tie", "sandpaper",
                                                  "clay_pot", "fine",       "smooth",    "air"};
  return kFamilies;
}

ScanCase simulate_own_case(std::uint64_t seed, const CaseChoice& choice) {
  Random random(seed, 0x636f76);
  ScanCase out;
  out.seed = seed;
  out.family = one_of(random, choice.families.empty() ? own_families() : choice.families);
  out.probe = one_of(random, choice.probes.empty() ? std::vector<std::string>{"open", "what"} : choice.probes);
  if (std::find(own_families().begin(), own_families().end(), out.family) == own_families().end())
    throw asperity::Error("no family '" + out.family + "'");
  const bool rough = out.family == "fine" || out.family == "smooth" || out.family == "air";
  const std::string material = random.chance(0.7) ? "stiff" : random.chance(0.5) ? "cork" : "soft_rubber";
  SimulationConfig config = asperity::make_simulation_config(rough ? "sandpaper" : out.family, out.probe, material);
  config.seed = static_cast<std::int64_t>(1 + seed);
  draw_surface(config, out.family, random, out);
  draw_hand(config, random);
  if (choice.paths == CasePaths::kCurved) config.hand.path = asperity::HandPathShape::kCurved;
  if (choice.paths != CasePaths::kCurved) draw_raster(config, seed, choice.paths);
  draw_faults(config, random);
  draw_slow_errors(config, random);
  if (choice.exact_calibration) config.calibration.imperfection = 0.0;
  const auto note = [&](bool has, const char* name) {
    if (has) out.conditions.emplace_back(name);
  };
  note(config.probe.batch_samples > 1, "batches");
  note(config.hand.pauses > 0, "static intervals in the stroke");
  note(config.hand.rest_s > 1.5, "long static intervals");
  note(config.tracker.mount_Hz > 0.0, "shaking marker");
  note(config.tracker.slow_share > 0.3, "tracker drift");
  note(config.hand.path == asperity::HandPathShape::kCurved, "curved");
  note(config.hand.path == asperity::HandPathShape::kBackAndForth, "raster");
  note(config.hand.force == asperity::HandForce::kRamp, "rising force");
  note(material != "stiff", "soft");
  if (out.family == "air") {
    out.nothing = true;
    out.recording = wave_in_the_air(config, random);
    return out;
  }
  out.nothing = out.family == "smooth";
  out.stiffness_N_per_mm = 1e-3 * config.contact.stiffness_N_per_m;
  out.recording = asperity::simulate_recording(config);
  return out;
}

}  // namespace bench
