#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "asperity/simulation/contact_config.h"
#include "asperity/simulation/hand_config.h"
#include "asperity/simulation/object_motion_config.h"
#include "asperity/simulation/probe_config.h"
#include "asperity/simulation/surface_config.h"
#include "asperity/simulation/tracker_config.h"

namespace asperity {

// Everything the virtual bench needs; see docs/virtual-bench.md for the mathematics and sources.
struct SimulationConfig {
  std::int64_t seed = 1;
  double step_s = 25e-6;                                        // of the integration
  std::array<double, 3> gravity_world_mps2{0.0, 9.80665, 0.0};  // a level camera
  SimulatedSurfaceConfig surface;
  SimulatedShapeConfig shape;
  SimulatedContactConfig contact;
  SimulatedObjectConfig object;
  HandConfig hand;
  SimulatedProbeConfig probe;
  SimulatedTrackerConfig tracker;
  SimulatedCalibrationConfig calibration;

  template <class V>
  void visit(V& v) {
    v.field("seed", seed, "of all randomness; the same seed gives the same bytes", {0.0, 9e15});
    v.field("step_s", step_s, "step of the integration, s", {1e-6, 1e-3});
    v.field("gravity_world_mps2", gravity_world_mps2, "gravity in the world frame, m/s²", {-100.0, 100.0});
    v.group("surface", surface);
    v.group("shape", shape);
    v.group("contact", contact);
    v.group("object", object);
    v.group("hand", hand);
    v.group("probe", probe);
    v.group("tracker", tracker);
    v.group("calibration", calibration);
  }
};

// The defaults for a surface (one of kSurfaceNames but "file", or a path to a height CSV or areal map:
// anything with a dot or slash), a probe ("what" or "open") and what the surface is made of (one of
// kContactMaterialNames). Throws Error for an unknown name.
SimulationConfig make_simulation_config(std::string_view surface, std::string_view probe,
                                        std::string_view material = "stiff");

}  // namespace asperity
