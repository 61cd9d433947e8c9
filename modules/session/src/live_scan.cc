#include "asperity/session/live_scan.h"

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/write_recording.h"

namespace asperity {

LiveScan::LiveScan(const Recording& recording, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
                   const std::filesystem::path& folder)
    : folder_(std::filesystem::absolute(folder)),
      probe_(kProbeModelNames[static_cast<std::size_t>(probe.model)]),
      config_(config),
      bench_(recording, probe, config, folder_) {
  write_calibration(folder_ / "calibration.json", recording.calibration);
  const Calibration& calibration = recording.calibration;
  if (!calibration.camera || calibration.markers.empty()) throw Error("the recording has no camera with markers");
  write_file(folder_ / "camera.json", Json{{"camera", camera_json(*calibration.camera)}}.dump(1) + "\n");
  write_file(folder_ / "markers.json", Json{{"markers", markers_json(calibration.markers)}}.dump(1) + "\n");
}

Json LiveScan::announcement() const {
  Json out;
  out["format"] = "asperity-live";
  out["version"] = 1;
  out["probe"] = probe_;
  out["port"] = port();
  out["camera"] = camera();
  out["calibration"] = calibration();
  out["markers"] = markers();
  out["duration_s"] = bench_.duration_s();
  out["wait_s"] = config_.wait_s;
  return out;
}

LiveReport LiveScan::play(const Observer& observer) {
  if (!bench_.wait_for_readers(observer)) {
    throw Error(fmt::format("no program has opened {} and {} within {} s (live.wait_s)", port(),
                            printable(camera(), 200), config_.wait_s));
  }
  return bench_.play(observer);
}

Json live_json(const LiveReport& report, const std::string& recording) {
  Json out;
  out["format"] = "asperity-live-played";
  out["version"] = 1;
  out["recording"] = recording;
  out["probe_bytes"] = report.probe_bytes;
  out["probe_bytes_lost"] = report.probe_bytes_lost;
  out["frames"] = report.frames;
  out["frames_lost"] = report.frames_lost;
  out["frames_dropped"] = report.frames_dropped;
  out["latest_probe_s"] = report.latest_probe_s;
  out["latest_frame_s"] = report.latest_frame_s;
  out["bytes_flipped"] = report.flipped;
  out["bytes_dropped"] = report.dropped;
  out["bytes_inserted"] = report.inserted;
  return out;
}

std::string live_line(const LiveReport& report, const std::string& recording) {
  std::string line = fmt::format("{}: played {} bytes and {} images, at most {:.1f} ms and {:.1f} ms late\n",
                                 printable(recording, 200), report.probe_bytes, report.frames,
                                 1e3 * report.latest_probe_s, 1e3 * report.latest_frame_s);
  if (report.probe_bytes_lost + report.frames_lost > 0)
    line += fmt::format("{} bytes and {} images were not read\n", report.probe_bytes_lost, report.frames_lost);
  if (report.frames_dropped > 0)
    line += fmt::format("{} images were dropped: the machine was too slow for them\n", report.frames_dropped);
  return line;
}

}  // namespace asperity
