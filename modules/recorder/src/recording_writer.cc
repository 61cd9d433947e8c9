#include "recording_writer.h"

#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/recording/write_recording.h"

namespace asperity {

namespace {

RecordingInfo with_description(RecordingInfo info, const std::optional<ProbeDescription>& description) {
  if (!description) return info;
  info.probe_model = printable(description->model);
  info.probe_rate_Hz = description->rate_Hz;
  info.adc_min = description->adc_min;
  info.adc_max = description->adc_max;
  return info;
}

AppendColumns columns_of(const std::optional<ProbeDescription>& description, bool has_poses) {
  AppendColumns out;
  out.gyro = description && description->has_gyro;
  out.force3 = description && description->force_axes == 3;
  out.markers = out.reprojection = out.sigmas = has_poses;
  return out;
}

std::optional<ForceCalibration> force_of(const Calibration& calibration) {
  if (calibration.uncalibrated) return std::nullopt;
  return calibration.force;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& folder, RecordingInfo info,
                                 const Calibration& calibration, const std::optional<ProbeDescription>& description,
                                 bool has_poses, const RecorderConfig& config)
    : config_(config),
      info_(with_description(std::move(info), description)),
      description_(description),
      force_(force_of(calibration)),
      contact_(config.contact, force_),
      gravity_(config.rest, calibration),
      appender_(folder, info_, calibration, columns_of(description, has_poses)),
      segments_(appender_, nanoseconds(config.pre_roll_s)) {
  for (const TrackedBody& body : info_.bodies) bodies_.emplace_back().name = body.name;
  if (config.mode == StoreMode::kSegments && config.start_at_once) begin("segment_", SegmentWriter::kFromFirstRow);
  write_recording_info(folder / "recording.json", current_info(false));
}

void RecordingWriter::add(std::span<const ProbeSample> samples) {
  for (const ProbeSample& sample : samples) {
    segments_.add(sample);
    gravity_.add_probe(sample.t_ns, sample.accel_counts);
    if (!std::isfinite(sample.force_counts)) continue;
    force_N_ = force_ ? force_->force_N(sample.force_counts) : sample.force_counts;
    if (const auto change = contact_.push(sample.t_ns, sample.force_counts)) touch(*change);
  }
  if (segments_.settle()) changed_ = true;
}

void RecordingWriter::add(std::span<const TrackerSample> poses) {
  for (const TrackerSample& pose : poses) {
    if (pose.body > bodies_.size()) continue;  // a body that this recording does not have
    segments_.add(pose);
    if (pose.body > 0) {
      bodies_[pose.body - 1].pose = pose;
      continue;
    }
    gravity_.add_pose(pose.t_ns, pose.T_world_marker);
    pose_ = pose;
  }
  if (segments_.settle()) changed_ = true;
}

void RecordingWriter::touch(const ContactChange& change) {
  if (change.touching) ++touches_;
  if (config_.mode != StoreMode::kAuto) return;
  if (change.touching) {
    // Touching again before the post-roll is over goes on with the same segment.
    if (!segments_.reopen()) begin("contact_", change.t_ns);
  } else if (segments_.is_open()) {
    segments_.end_at(change.t_ns + nanoseconds(config_.post_roll_s));
  }
}

void RecordingWriter::begin(std::string name, std::int64_t t_ns) {
  if (name.ends_with('_')) name += std::to_string(segments_.count() + 1);
  if (!segments_.start(std::move(name), t_ns, nanoseconds(config_.pre_roll_s))) ++refused_;
  changed_ = true;
}

void RecordingWriter::apply(const RecorderCommand& command) {
  const bool by_hand = config_.mode == StoreMode::kSegments;
  switch (command.kind) {
    case RecorderCommand::Kind::kStart:
      if (!by_hand || (segments_.is_open() && !segments_.is_ending())) return;
      segments_.close(command.t_ns);
      begin(command.name.empty() ? "segment_" : command.name, command.t_ns);
      return;
    case RecorderCommand::Kind::kStop:
      if (by_hand) segments_.end_at(command.t_ns);
      return;
    case RecorderCommand::Kind::kDiscard:
    case RecorderCommand::Kind::kRescan: {
      const auto name = segments_.discard(command.t_ns);
      if (!name) return;
      changed_ = true;
      if (by_hand && command.kind == RecorderCommand::Kind::kRescan) begin(*name, command.t_ns);
      return;
    }
    case RecorderCommand::Kind::kRestore:
      if (segments_.restore()) changed_ = true;
      return;
    case RecorderCommand::Kind::kByHand:
      // Where the touch's end has set one, the segment would stop by itself.
      if (!by_hand) segments_.reopen();
      config_.mode = StoreMode::kSegments;
      return;
    case RecorderCommand::Kind::kByContact:
      config_.mode = StoreMode::kAuto;
      if (contact_.touching() && !segments_.is_open()) begin("contact_", command.t_ns);
      return;
  }
}

void RecordingWriter::pass_time(std::int64_t now_ns) {
  constexpr std::int64_t kLatest_ns = 300'000'000;
  if (segments_.settle(now_ns - kLatest_ns)) changed_ = true;
}

void RecordingWriter::note_description(const std::optional<ProbeDescription>& description) {
  if (!description) return;
  const AppendColumns wanted = columns_of(description, false);
  const AppendColumns stored = columns_of(description_, false);
  if ((wanted.gyro && !stored.gyro) || (wanted.force3 && !stored.force3)) columns_missing_ = true;
}

RecordingInfo RecordingWriter::current_info(bool finished) const {
  RecordingInfo out = info_;
  out.segments = segments_.segments();
  const GravityEstimate gravity = gravity_.estimate();
  if (gravity.measured) out.gravity_world_mps2 = gravity.gravity_world_mps2;
  for (const auto& [name, count] : problems_) {
    if (count > 0) out.problems[name] = count;
  }
  const auto problem = [&](const char* name, std::uint64_t count) {
    if (count > 0) out.problems[name] = static_cast<std::int64_t>(count);
  };
  problem("rows_out_of_order", segments_.late_rows());
  problem("segments_refused", refused_);
  problem("gravity_implausible", gravity.implausible ? 1 : 0);
  problem("columns_missing", columns_missing_ ? 1 : 0);

  RecorderState& recorder = out.recorder.emplace();
  recorder.state = finished ? "finished" : "recording";
  recorder.mode = kStoreModeNames.at(static_cast<std::size_t>(config_.mode));
  recorder.last_segment_is_open = segments_.is_open();
  recorder.discarded_until_ns = segments_.discarded_until_ns();
  recorder.discarded_segments = static_cast<std::int64_t>(segments_.discarded());
  if (!finished) recorder.discarded = segments_.discarded_rows();
  recorder.gravity = GravityAtRest{gravity.measured, gravity.windows, gravity.scatter_mps2};
  if (description_) {
    recorder.probe_name = printable(description_->name);
    recorder.probe_firmware = printable(description_->firmware);
  }
  return out;
}

std::optional<RecordingInfo> RecordingWriter::commit() {
  appender_.flush();
  const bool measured = gravity_.estimate().measured;
  if (!changed_ && measured == gravity_written_) return std::nullopt;
  changed_ = false;
  gravity_written_ = measured;
  return current_info(false);
}

void RecordingWriter::finish() {
  segments_.close(segments_.latest_ns());
  gravity_.finish();
  appender_.finish(current_info(true), segments_.discarded() > 0);
}

void RecordingWriter::describe(RecorderSnapshot& out) const {
  out.columns_missing = columns_missing_;
  out.force_N = force_N_;
  out.force_is_calibrated = force_.has_value();
  out.touching = contact_.touching();
  out.contact_ready = contact_.ready();
  out.touches = touches_;
  out.pose = pose_;
  out.bodies = bodies_;
  for (std::size_t i = 0; i < out.bodies.size(); ++i) out.bodies[i].rows = segments_.body_rows(i + 1);
  out.storing = segments_.is_open();
  out.segments = segments_.count();
  out.segment_list = segments_.segments();
  out.automatic = config_.mode == StoreMode::kAuto;
  out.segment = segments_.last_name();
  out.discarded = segments_.discarded();
  out.restored = segments_.restored();
  if (!segments_.discarded_rows().empty()) out.last_discarded = segments_.discarded_rows().back();
  out.recorded_s = segments_.recorded_s();
  out.probe_rows = segments_.probe_rows();
  out.tracker_rows = segments_.tracker_rows();
  out.disk_bytes = appender_.bytes();
  out.gravity = gravity_.estimate();
}

}  // namespace asperity
