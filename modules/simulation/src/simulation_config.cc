#include "asperity/simulation/simulation_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

void set_surface(SimulationConfig& config, std::string_view name) {
  SimulatedSurfaceConfig& surface = config.surface;
  if (name == "sine") {
    surface.kind = SurfaceKind::kSine;
  } else if (name == "protoboard") {
    surface.kind = SurfaceKind::kProtoboard;
    surface.pitch_m = 2.5e-3;
  } else if (name == "cable_tie") {
    surface.kind = SurfaceKind::kCableTie;
    surface.pitch_m = 1.2e-3;
  } else if (name == "sandpaper") {
    surface.kind = SurfaceKind::kSandpaper;
  } else if (name == "clay_pot") {
    surface.kind = SurfaceKind::kClayPot;
    surface.rq_m = 25e-6;
    surface.low_cycles_per_mm = 0.5;
    surface.high_cycles_per_mm = 3.0;
    config.shape.kind = BaseShapeKind::kCylinder;
  } else if (name.find_first_of("./") != std::string_view::npos) {
    surface.kind = SurfaceKind::kFile;
    surface.file = std::string(name);
  } else {
    throw Error(fmt::format("unknown surface '{}': sine, protoboard, cable_tie, sandpaper, clay_pot or a file",
                            printable(name)));
  }
}

void set_what(SimulationConfig& config) {
  SimulatedProbeConfig& probe = config.probe;
  probe.model = ProbeModel::kWhat;
  probe.sensor_in_marker_m = probe.tip_in_marker_m;
  probe.nominal_rate_Hz = 500.0;
  probe.true_rate_Hz = 400.0;
  probe.adc_min = 0.0;
  probe.adc_max = 255.0;
  probe.accel_noise_mps2_per_rtHz = 2.0e-3;
  probe.accel_bandwidth_Hz = 200.0;
  probe.accel_poles = 1;
  probe.gyroscope = false;
  probe.force_rate_Hz = 400.0;
  probe.force_noise_N = 0.01;
  probe.force_bandwidth_Hz = 150.0;
  probe.clock_jitter_s = 0.0;
  probe.clock_step_s = 1e-3;
  probe.delivery_delay_s = 0.5e-3;
  probe.dropout_chance = 0.002;
  probe.dropout_samples = 8.0;
  probe.spike_chance = 0.004;

  SimulatedTrackerConfig& tracker = config.tracker;
  tracker.rate_Hz = 45.0;
  tracker.latency_s = 0.022;
  tracker.clock_jitter_s = 0.5e-3;
  tracker.clock_step_s = 1e-3;
  tracker.dropout_chance = 0.006;
  tracker.flip_chance = 0.003;

  config.calibration.accel_scale = 0.01;
  config.calibration.accel_bias_mps2 = 0.1;
  config.calibration.force_scale = 0.02;
  config.calibration.force_offset_N = 0.05;
  config.calibration.latency_s = 4e-3;
}

}  // namespace

SimulationConfig make_simulation_config(std::string_view surface, std::string_view probe, std::string_view material) {
  SimulationConfig config;
  set_surface(config, surface);
  if (probe == "what") {
    set_what(config);
  } else if (probe != "open") {
    throw Error(fmt::format("unknown probe '{}': what or open", printable(probe)));
  }
  const auto found = std::find(kContactMaterialNames.begin(), kContactMaterialNames.end(), material);
  if (found == kContactMaterialNames.end()) {
    throw Error(fmt::format("unknown material '{}': stiff, cork or soft_rubber", printable(material)));
  }
  config.contact = make_contact(static_cast<ContactMaterial>(found - kContactMaterialNames.begin()));
  return config;
}

}  // namespace asperity
