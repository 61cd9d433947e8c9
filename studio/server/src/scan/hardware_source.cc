#include "scan/hardware_source.h"

#include <utility>

#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

void check_input(const RecordInput& input) {
  if (input.probe.empty())
    throw Advice("no probe is named", "Give its address, such as serial:/dev/ttyUSB0 or udp:5005.");
  if (!input.camera.empty() && !input.poses.empty())
    throw Advice("both a camera and another tracker are named", "Remove one of the two addresses.");
  if (input.calibration.empty() && !input.uncalibrated)
    throw Advice("no calibration is named",
                 "Name a calibration.json of the project's folder, or choose to record without one.");
  if (!input.calibration.empty() && input.uncalibrated)
    throw Advice("a calibration is named, but the recording is set to have none", "Choose one of the two.");
  if (!input.camera.empty() && input.uncalibrated)
    throw Advice("a camera needs its calibration to find poses",
                 "Name a calibration.json with the camera in it, or remove the camera's address.");
  if (!input.markers.empty() && input.camera.empty())
    throw Advice("markers are named without a camera", "Give the camera's address, or remove the markers.");
}

class HardwareSource : public ScanSource {
 public:
  HardwareSource(RecordInput input, std::string world) : input_(std::move(input)), world_(std::move(world)) {
    check_input(input_);
    calibration_ = read_record_calibration(input_);
  }

  RecorderSensors sensors(const TrackConfig& track, const std::function<void(const CameraFrame&)>& on_frame) override {
    return make_record_sensors(input_, calibration_, track, on_frame);
  }
  const std::optional<Calibration>& calibration() const override { return calibration_; }

  RecordingInfo info() const override {
    RecordingInfo out;
    out.world = world_;
    out.bodies = record_bodies(input_, calibration_);
    if (world_ == "z_up") out.gravity_world_mps2 = {0.0, 0.0, -out.gravity_world_mps2.norm()};
    return out;
  }

 private:
  RecordInput input_;
  std::string world_;
  std::optional<Calibration> calibration_;
};

}  // namespace

std::unique_ptr<ScanSource> make_hardware_source(const RecordInput& input, const std::string& world) {
  return std::make_unique<HardwareSource>(input, world);
}

}  // namespace asperity::studio
