#include "asperity/session/record_live.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/camera/open_y4m.h"
#include "asperity/link/probe_source.h"
#include "asperity/recorder/recorder.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/live_scan.h"
#include "asperity/simulation/probe_device.h"
#include "asperity/simulation/stamp_delay.h"
#include "asperity/tracking/camera_pose_source.h"
#include "asperity/transport/open_serial.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr int kBaud = 921'600;  // a pseudo-terminal does not mind

ProbeProtocol protocol_of(const SimulatedProbeConfig& probe) {
  return probe.model == ProbeModel::kWhat ? ProbeProtocol::kWhat : ProbeProtocol::kOpen;
}

bool has_ended(const SensorSnapshot& sensor) {
  return sensor.state == SensorState::kEnded || sensor.state == SensorState::kLost;
}

}  // namespace

LiveRecording record_live(const Recording& scan, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
                          const Calibration& calibration, const fs::path& folder, const Observer& observer) {
  constexpr auto kLook = std::chrono::milliseconds(20);
  constexpr double kLearning_s = 1.2;
  const fs::path live_folder = folder.string() + ".live";
  fs::create_directories(live_folder);
  fs::create_directories(folder);
  LiveRecording out;
  Recording bench;
  {
    LiveScan live(scan, probe, config, live_folder);
    std::atomic<bool> stop{false};
    std::atomic<bool> played{false};
    std::exception_ptr failure;
    Observer watch;
    watch.cancelled = [&stop] { return stop.load(); };
    std::thread player([&] {
      try {
        out.played = live.play(watch);
      } catch (...) {
        failure = std::current_exception();
      }
      played = true;
    });
    try {
      RecorderSensors sensors;
      sensors.open_probe = [&] {
        return make_probe_source(ProbeLink(open_serial(live.port(), kBaud), protocol_of(probe)));
      };
      sensors.open_poses = [&] {
        return make_camera_pose_source(open_y4m(live.camera()),
                                       BodyTracker(calibration.camera.value(), calibration.markers),
                                       {false, config.camera.rate_Hz});
      };
      sensors.probe_describes_itself = probe.model == ProbeModel::kOpen;
      sensors.reopen_probe = false;
      sensors.reopen_poses = false;
      RecorderConfig settings;
      settings.start_at_once = true;
      settings.describe_s = 30.0;
      RecordingInfo info;
      info.created = scan.info.created;
      info.object = scan.info.object;
      info.gravity_world_mps2 = scan.info.gravity_world_mps2;
      info.simulation.emplace().is_live = true;
      Recorder recorder(folder, info, calibration, std::move(sensors), settings);
      // The camera's end comes when the tracker has worked off its last frame, also on a machine that is too slow.
      while (!played || !has_ended(recorder.snapshot().poses)) {
        if (played && failure) break;
        observer.update("recording", 0.5);
        std::this_thread::sleep_for(kLook);
      }
      out.recorder = recorder.finish();
    } catch (...) {
      stop = true;
      player.join();
      throw;
    }
    player.join();
    if (failure) std::rethrow_exception(failure);
    bench = live.on_host_clock();
  }
  write_file(folder / "truth.csv", format_truth_csv(*bench.truth));
  fs::remove_all(live_folder);
  out.recording = read_recording(folder);
  out.stamp_delay_s = stamp_delay_s(out.recording.probe, bench, kLearning_s);
  return out;
}

ReceivedProbe through_link(const Recording& recording, const SimulatedProbeConfig& probe) {
  const std::unique_ptr<ProbeDecoder> decoder = make_probe_decoder(protocol_of(probe));
  std::vector<ProbeSample> samples;
  for (const ProbeBytes& arrived : send_recording(recording, probe))
    decoder->push(arrived.bytes, arrived.t_ns, samples);
  ReceivedProbe out{recording, decoder->description().value_or(ProbeDescription{})};
  ProbeStream& probe_rows = out.recording.probe;
  probe_rows = {};
  for (const ProbeSample& sample : samples) {
    probe_rows.t_ns.push_back(sample.t_ns);
    probe_rows.accel_counts.push_back(sample.accel_counts);
    probe_rows.force_counts.push_back(sample.force_counts);
    if (recording.probe.has_gyro()) probe_rows.gyro_counts.push_back(sample.gyro_counts);
  }
  return out;
}

TrackerStream track_frames(BenchCamera& camera, BodyTracker& tracker, const Observer& observer) {
  TrackerStream out;
  GrayImage image;
  for (std::size_t frame = 0; frame < camera.frames(); ++frame) {
    observer.update("tracking", static_cast<double>(frame) / static_cast<double>(camera.frames()));
    camera.render(frame, image);
    const auto pose = tracker.push(image, camera.time(frame).stamp_ns);
    if (!pose) continue;
    out.t_ns.push_back(pose->sample.t_ns);
    out.T_world_marker.push_back(pose->sample.T_world_marker);
    out.markers.push_back(pose->sample.markers);
    out.reprojection_px.push_back(pose->sample.reprojection_px);
    const TrackerSample row = with_sigmas(*pose);
    out.sigma_position_m.push_back(row.sigma_position_m);
    out.sigma_rotation_rad.push_back(row.sigma_rotation_rad);
    out.noise_position_m.push_back(row.noise_position_m);
    out.noise_rotation_rad.push_back(row.noise_rotation_rad);
  }
  return out;
}

}  // namespace asperity
