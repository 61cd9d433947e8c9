#include "asperity/simulation/simulate_recording.h"

#include <gtest/gtest.h>

namespace asperity {
namespace {

SimulationConfig short_config(const char* surface, const char* probe) {
  SimulationConfig config = make_simulation_config(surface, probe);
  config.hand.length_m = 0.01;
  return config;
}

TEST(SimulateRecording, SameSeedSameData) {
  for (const char* probe : {"open", "what"}) {
    const Recording a = simulate_recording(short_config("sandpaper", probe));
    const Recording b = simulate_recording(short_config("sandpaper", probe));
    EXPECT_EQ(a.probe.t_ns, b.probe.t_ns);
    EXPECT_EQ(a.probe.accel_counts, b.probe.accel_counts);
    EXPECT_EQ(a.tracker.t_ns, b.tracker.t_ns);
    EXPECT_EQ(a.truth->height_m, b.truth->height_m);
    EXPECT_EQ(a.calibration.accelerometer.B, b.calibration.accelerometer.B);
  }
}

}  // namespace
}  // namespace asperity
