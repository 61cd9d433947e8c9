#include "asperity/session/record_input.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/camera/open_camera.h"
#include "asperity/link/capture_to_file.h"
#include "asperity/link/probe_address.h"
#include "asperity/link/probe_link.h"
#include "asperity/recording/read_markers.h"
#include "asperity/recording/read_recording.h"
#include "asperity/tracking/camera_pose_source.h"
#include "asperity/tracking/open_pose_stream.h"

namespace asperity {

namespace {

ProbeProtocol protocol_of(const std::string& name) {
  const auto found = std::find(kProbeProtocolNames.begin(), kProbeProtocolNames.end(), name);
  if (found == kProbeProtocolNames.end()) throw Error("--protocol: '" + printable(name) + "' is neither what nor open");
  return static_cast<ProbeProtocol>(found - kProbeProtocolNames.begin());
}

template <class Parse>
auto address_of(const char* option, const Parse& parse, const std::string& text) {
  try {
    return parse(text);
  } catch (const Error& error) {
    throw Error(std::string(option) + ": " + error.what());
  }
}

// A device may come back; a file's end is the end.
bool is_live(const CameraAddress& address) {
  return address.kind == CameraKind::kV4l2 ||
         (address.kind == CameraKind::kY4m && (address.path == "-" || std::filesystem::is_fifo(address.path)));
}

void add_camera(RecorderSensors& sensors, const RecordInput& input, const Calibration& calibration,
                const TrackConfig& track, const std::function<void(const CameraFrame&)>& on_frame) {
  const CameraAddress address = address_of("--camera", parse_camera_address, input.camera);
  const std::string file = printable(input.calibration, 200);
  if (!calibration.camera) throw Error(file + ": camera is missing; see asperity calibrate camera");
  if (calibration.markers.empty()) throw Error(file + ": markers are missing; give --markers");
  const CameraCalibration camera = *calibration.camera;
  const std::vector<MarkerPlacement> markers = calibration.markers, body = markers_of_body(markers, "");
  if (body.empty()) throw Error(file + ": markers: none is on the probe, all are on further bodies");
  CameraPoseConfig config;
  config.newest = is_live(address);
  config.nominal_rate_Hz = address.kind == CameraKind::kV4l2 ? address.v4l2.rate_Hz : address.images.rate_Hz;
  BodyTracker(camera, body, track);  // throws now, not in a thread
  make_further_trackers(camera, markers, track);
  sensors.reopen_poses = config.newest && address.path != "-";  // standard input does not come back
  sensors.reopen_silent_poses = address.kind == CameraKind::kV4l2;
  sensors.open_poses = [=] {
    return make_camera_pose_source(open_camera(address), BodyTracker(camera, body, track), config, on_frame,
                                   make_further_trackers(camera, markers, track));
  };
}

// The captures of one take. A link that is lost and comes back goes on in a file of its own: a capture is one run of a
// decoder. One thread at a time, but for failure().
class ProbeCaptures {
 public:
  explicit ProbeCaptures(std::string first) : first_(std::move(first)) {}

  // Throws Error if the first cannot be made, before the take begins. Any other ends the take by failure().
  std::unique_ptr<ByteSource> begin(std::unique_ptr<ByteSource> source) {
    if (++count_ == 1) return capture_to_file(std::move(source), first_, failure_);
    // What others have put under such a name is no reason to end a take.
    while (std::filesystem::exists(std::filesystem::symlink_status(path()))) ++count_;
    try {
      return capture_to_file(std::move(source), path(), failure_);
    } catch (const Error& error) {
      failure_->note(error.what());
      throw;
    }
  }
  std::string failure() const { return failure_->reason(); }

 private:
  std::string path() const { return first_ + "." + std::to_string(count_); }

  std::string first_;
  int count_ = 0;
  std::shared_ptr<CaptureFailure> failure_ = std::make_shared<CaptureFailure>();
};

}  // namespace

void check_record_addresses(const RecordInput& input) {
  protocol_of(input.protocol);
  address_of("--probe", parse_probe_address, input.probe);
  if (!input.camera.empty()) address_of("--camera", parse_camera_address, input.camera);
  if (!input.poses.empty()) address_of("--poses", parse_pose_address, input.poses);
}

std::optional<Calibration> read_record_calibration(const RecordInput& input) {
  if (input.uncalibrated) return std::nullopt;
  Calibration out = read_calibration(input.calibration);
  const std::string& markers = input.markers.empty() ? input.calibration : input.markers;
  if (input.markers.empty() && out.markers.empty()) return out;
  out.markers = read_markers(markers).markers;
  // They are now in terms of our tag frame, whatever the file had declared.
  out.tag_frame.reset();
  return out;
}

std::vector<TrackedBody> record_bodies(const RecordInput& input, const std::optional<Calibration>& calibration) {
  std::vector<TrackedBody> out;
  if (!input.camera.empty() && calibration) out = tracked_bodies(calibration->markers);
  if (input.poses.empty()) return out;
  for (const std::string& name : input.bodies) {
    if (!is_body_name(name)) {
      throw Error("--body: '" + printable(name) +
                  "' is not a body's name: 1 to 32 lower-case letters, digits, _ and -");
    }
    out.push_back({name, {}});
  }
  return out;
}

RecorderSensors make_record_sensors(const RecordInput& input, const std::optional<Calibration>& calibration,
                                    const TrackConfig& track, const std::function<void(const CameraFrame&)>& on_frame) {
  RecorderSensors out;
  const ProbeProtocol protocol = protocol_of(input.protocol);
  const ProbeAddress probe = address_of("--probe", parse_probe_address, input.probe);
  out.probe_describes_itself = protocol == ProbeProtocol::kOpen;
  out.reopen_probe = probe.kind != ProbeLinkKind::kFile;
  out.reopen_silent_probe = probe.kind != ProbeLinkKind::kUdp;
  out.replayed = !out.reopen_probe;
  if (!input.capture.empty()) {
    const auto captures = std::make_shared<ProbeCaptures>(input.capture);
    out.open_probe = [=] {
      return make_probe_source(ProbeLink(captures->begin(open_probe_source(probe, protocol)), protocol));
    };
    out.failure_besides = [captures] { return captures->failure(); };
  } else {
    out.open_probe = [=] { return make_probe_source(ProbeLink(open_probe_source(probe, protocol), protocol)); };
  }
  if (!input.camera.empty()) add_camera(out, input, *calibration, track, on_frame);
  if (!input.poses.empty()) {
    const PoseAddress poses = address_of("--poses", parse_pose_address, input.poses);
    out.reopen_poses = poses.kind != PoseAddress::Kind::kFile;
    out.reopen_silent_poses = false;
    out.open_poses = [=, bodies = input.bodies] { return open_pose_stream(poses, bodies); };
  }
  return out;
}

}  // namespace asperity
