#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "asperity/camera/camera_source.h"
#include "asperity/recorder/recorder.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/tracked_body.h"
#include "asperity/tracking/track_body.h"

namespace asperity {

// The sensors of a recording, as typed.
struct RecordInput {
  std::string probe;
  std::string protocol = "open";
  std::string capture;  // where the probe's bytes are kept too, or empty
  std::string camera;
  std::string markers;
  std::string poses;
  std::vector<std::string> bodies;  // further ones whose lines `poses` has, by name
  std::string calibration;
  bool uncalibrated = false;
};

// Throws Error naming the option for an address or a protocol that is none.
void check_record_addresses(const RecordInput& input);

// calibration.json with the markers of markers.json where there is one; nullopt for --uncalibrated. Throws Error naming
// the file.
std::optional<Calibration> read_record_calibration(const RecordInput& input);

// The bodies that are tracked in addition to the probe's: those of the calibration's markers with a camera, those that
// are named with a stream of poses. Throws Error naming the option for a name that is none.
std::vector<TrackedBody> record_bodies(const RecordInput& input, const std::optional<Calibration>& calibration);

// The functions that open the sensors. `on_frame` is given the camera's images. Throws Error for an address that is
// none, and for a camera without a calibration or markers.
RecorderSensors make_record_sensors(const RecordInput& input, const std::optional<Calibration>& calibration,
                                    const TrackConfig& track, const std::function<void(const CameraFrame&)>& on_frame);

}  // namespace asperity
