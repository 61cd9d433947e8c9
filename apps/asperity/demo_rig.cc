#include "demo_rig.h"

#include "asperity/tracking/track_body.h"

namespace asperity::app {

Recording simulate_motion(const DemoRig& rig, const MotionFunction& motion, double duration_s, const char* object,
                          const Observer& observer) {
  const SimulationConfig config = rig.in_the_air();
  Recording recording = simulate_motion(config, motion, duration_s, object, observer);
  add_bench_camera(recording, rig.live);
  return recording;
}

TrackerStream track_motion(const DemoRig& rig, const Recording& recording, double rate_Hz, std::int64_t seed,
                           const Observer& observer) {
  SimulatedCameraConfig config = rig.live.camera;
  config.rate_Hz = rate_Hz;
  config.seed = seed;
  BenchCamera camera(config, recording.calibration.markers, recording, recording.calibration.tracker.latency_s,
                     rig.live.stamp_jitter_s);
  BodyTracker tracker(rig.calibration.camera.value(), rig.calibration.markers);
  return track_frames(camera, tracker, observer);
}

LiveRecording record_scan(const DemoRig& rig, const Recording& scan, const char* name, const Observer& observer) {
  return record_live(scan, rig.simulation.probe, rig.live, rig.calibration, rig.folder / name, observer);
}

}  // namespace asperity::app
