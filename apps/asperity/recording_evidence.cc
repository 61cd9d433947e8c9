#include "recording_evidence.h"

#include <string>

namespace asperity::app {

namespace {

RecordingEvidence::Source source_evidence(std::string name, const SensorSnapshot& sensor) {
  return {std::move(name), sensor.failed, sensor.lost, sensor.state == SensorState::kEnded, sensor.message};
}

}  // namespace

RecordingEvidence recording_evidence(const RecorderSnapshot& end, const FrameWriter::FrameCounts& frames,
                                     bool awaits_contact, bool calibrated) {
  RecordingEvidence out;
  out.samples = end.probe.received;
  out.samples_sent = end.link.samples + end.link.lost_samples;
  out.samples_lost = end.link.lost_samples;
  out.losses_are_estimated = end.link.losses_are_estimated;
  out.samples_overflowed = end.probe.overflowed;
  out.rows_stored = end.probe_rows;
  out.overruns = end.link.overruns;
  out.sensor_faults = describe_faults(end.link.faults);
  out.columns_missing = end.columns_missing;
  out.probe_message = end.probe.message;
  out.awaits_contact = awaits_contact;
  out.touches = end.touches;
  out.calibrated = calibrated;
  out.has_tracker = end.poses.state != SensorState::kAbsent;
  out.frames = end.tracking.frames;
  out.frames_skipped = end.tracking.skipped_frames;
  out.poses = end.tracking.poses;
  out.poses_stored = end.tracker_rows;
  out.poses_overflowed = end.poses.overflowed;
  out.tracker_message = end.poses.message;
  out.frames_not_kept = frames.dropped;
  out.sources = {source_evidence("the probe", end.probe), source_evidence("the tracker", end.poses)};
  out.gravity_measured = end.gravity.measured;
  out.gravity_implausible = end.gravity.implausible;
  return out;
}

}  // namespace asperity::app
