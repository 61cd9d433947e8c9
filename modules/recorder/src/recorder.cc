#include "asperity/recorder/recorder.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/recording/uncalibrated.h"
#include "bounded_queue.h"
#include "pose_thread.h"
#include "probe_thread.h"
#include "recording_info_writer.h"
#include "recording_writer.h"

namespace asperity {

// Events in the last second, in steps of a tenth.
class RateMeter {
 public:
  explicit RateMeter(std::int64_t now_ns) : step_(now_ns / kStep_ns) {}

  void add(std::int64_t now_ns, std::uint64_t count) {
    move_to(now_ns);
    counts_[slot(step_)] += count;
  }

  // Of the ten whole steps before now.
  double rate_Hz(std::int64_t now_ns) {
    move_to(now_ns);
    std::uint64_t sum = 0;
    for (std::int64_t step = step_ - kSteps; step < step_; ++step) sum += counts_[slot(step)];
    return static_cast<double>(sum);
  }

 private:
  static constexpr std::int64_t kStep_ns = 100'000'000;
  static constexpr std::int64_t kSteps = 10;

  static std::size_t slot(std::int64_t step) { return static_cast<std::size_t>(step % (kSteps + 1)); }

  void move_to(std::int64_t now_ns) {
    const std::int64_t now = now_ns / kStep_ns;
    if (now - step_ > kSteps) {
      counts_.fill(0);
      step_ = now;
    }
    while (step_ < now) counts_[slot(++step_)] = 0;
  }

  std::int64_t step_;
  std::array<std::uint64_t, kSteps + 1> counts_{};
};

namespace fs = std::filesystem;

namespace {

// What the sensors and queues have lost, as counts for recording.json (docs/recorder.md); zeros are left out.
std::map<std::string, std::int64_t> sensor_problems(const RecorderSnapshot& now) {
  std::map<std::string, std::int64_t> out;
  const auto count = [&](const char* name, std::uint64_t value) {
    if (value > 0) out[name] = static_cast<std::int64_t>(value);
  };
  count(now.link.losses_are_estimated ? "probe_lost_samples_estimated" : "probe_lost_samples", now.link.lost_samples);
  count(now.link.losses_are_estimated ? "probe_lost_frames_estimated" : "probe_lost_frames", now.link.lost_frames);
  count("probe_damaged_frames", now.link.damaged_frames);
  count("probe_late_frames", now.link.late_frames);
  count("probe_resyncs", now.link.resyncs);
  count("probe_restarts", now.link.restarts);
  count("probe_overruns", now.link.overruns);
  count("probe_imu_bus_failures", now.link.faults.imu_bus_failures);
  count("probe_imu_overflows", now.link.faults.imu_overflows);
  count("probe_imu_lost_sync", now.link.faults.imu_lost_sync);
  count("probe_imu_invalid_rows", now.link.faults.imu_invalid_rows);
  count("probe_imu_restarts", now.link.faults.imu_restarts);
  count("probe_force_bus_failures", now.link.faults.force_bus_failures);
  count("probe_force_skipped", now.link.faults.force_skipped);
  count("probe_force_restarts", now.link.faults.force_restarts);
  count("probe_queue_overflow", now.probe.overflowed);
  count("probe_disappeared", now.probe.lost);
  count("tracker_skipped_frames", now.tracking.skipped_frames);
  count("tracker_queue_overflow", now.poses.overflowed);
  count("tracker_disappeared", now.poses.lost);
  return out;
}

constexpr std::size_t kMostCommands = 1000;

void check_new(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && (!fs::is_directory(folder, error) || !fs::is_empty(folder, error)))
    throw Error(folder.string() + ": exists and is not empty; nothing was changed");
}

// Takes the rows up to `t_ns` off the front of `rows`.
template <class Row>
std::span<const Row> split_before(std::span<const Row>& rows, std::int64_t t_ns) {
  std::size_t count = 0;
  while (count < rows.size() && rows[count].t_ns <= t_ns) ++count;
  const auto out = rows.first(count);
  rows = rows.subspan(count);
  return out;
}

double seconds(std::int64_t time_ns) { return static_cast<double>(time_ns) * kNanosecond_s; }

}  // namespace

class Recorder::Parts {
 public:
  Parts(const fs::path& folder, const RecordingInfo& info, const std::optional<Calibration>& calibration,
        RecorderSensors sensors, const RecorderConfig& config)
      : config_(config),
        replayed_(sensors.replayed),
        failure_besides_(sensors.failure_besides),
        start_ns_(host_now_ns()),
        probe_rate_(start_ns_),
        pose_rate_(start_ns_) {
    check_new(folder);
    if (!sensors.open_probe) throw Error("recorder: the probe is missing");
    probe_.emplace(std::move(sensors.open_probe), sensors.reopen_probe, sensors.reopen_silent_probe, config);
    if (sensors.open_poses)
      poses_.emplace(std::move(sensors.open_poses), sensors.reopen_poses, sensors.reopen_silent_poses, config);
    if (sensors.probe_describes_itself) probe_->wait_for_description(config.describe_s);
    start_ns_ = host_now_ns();  // the wait is none of the recording's time
    const auto description = probe_->description();
    writer_.emplace(folder, with_tracker(info, calibration), calibration ? *calibration : nominal(description),
                    description, poses_.has_value(), config);
    info_writer_.emplace(folder, with_tracker(info, calibration).bodies, config.sync_s);
    thread_ = std::thread([this] { run(); });
  }

  ~Parts() { stop(); }

  void ask(RecorderCommand::Kind kind, std::string name) {
    const std::lock_guard lock(mutex_);
    if (commands_.size() < kMostCommands) commands_.push_back({kind, std::move(name), host_now_ns()});
  }

  RecorderSnapshot snapshot() const {
    const std::lock_guard lock(snapshot_mutex_);
    return snapshot_;
  }

  RecorderSnapshot finish() {
    stop();
    if (!snapshot_.failure.empty()) throw Error(snapshot_.failure);
    return snapshot_;
  }

 private:
  RecordingInfo with_tracker(RecordingInfo info, const std::optional<Calibration>& calibration) const {
    if (poses_ && calibration && info.bodies.empty()) info.bodies = tracked_bodies(calibration->markers);
    if (poses_ && poses_->nominal_rate_Hz() > 0.0) info.tracker_rate_Hz = poses_->nominal_rate_Hz();
    return info;
  }

  static Calibration nominal(const std::optional<ProbeDescription>& known) {
    const ProbeDescription probe = known.value_or(ProbeDescription{});
    return make_uncalibrated(probe.accel_counts_per_mps2, probe.has_gyro ? probe.gyro_counts_per_radps : 0.0,
                             probe.force_newton_per_count);
  }

  void stop() {
    if (!thread_.joinable()) return;
    probe_->stop();
    if (poses_) poses_->stop();
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  bool stop_asked() {
    std::unique_lock lock(mutex_);
    // A file waits for the queue, which is not to make it slow.
    const double period_s = replayed_ ? std::min(config_.flush_s, 0.005) : config_.flush_s;
    return changed_.wait_for(lock, std::chrono::duration<double>(period_s), [this] { return stop_; });
  }

  // The writing thread. The sensors have stopped before it is asked to: its last round takes all there is.
  void run() {
    for (bool last = false; !last;) {
      last = stop_asked();
      try {
        do_round(last);
      } catch (const std::exception& error) {  // no memory for a snapshot: rows may have been lost with it
        if (failure_.empty()) failure_ = error.what();
        const std::lock_guard lock(snapshot_mutex_);
        snapshot_.failure = failure_;
      }
    }
  }

  void do_round(bool last) {
    RecorderSnapshot now = take_round();
    const std::int64_t before_ns = host_now_ns();
    // When the disk has failed, memory stays bounded and the figures go on.
    if (failure_.empty()) write_round(now, last);
    highest_write_s_ = std::max(highest_write_s_, seconds(host_now_ns() - before_ns));
    if (refused_besides_.empty() && failure_besides_) refused_besides_ = failure_besides_();
    publish(std::move(now));
  }

  // Empties the queues; how the sensors stand.
  RecorderSnapshot take_round() {
    RecorderSnapshot out;
    probe_->describe(out);
    out.description = probe_->description();
    probe_->take(probe_rows_);
    if (poses_) {
      poses_->describe(out);
      poses_->take(pose_rows_);
    }
    const std::int64_t now_ns = host_now_ns();
    out.running_s = seconds(now_ns - start_ns_);
    probe_rate_.add(now_ns, probe_rows_.size());
    pose_rate_.add(now_ns, pose_rows_.size());
    out.probe.rate_Hz = probe_rate_.rate_Hz(now_ns);
    out.poses.rate_Hz = pose_rate_.rate_Hz(now_ns);
    return out;
  }

  void write_round(const RecorderSnapshot& now, bool last) {
    std::vector<RecorderCommand> commands;
    {
      const std::lock_guard lock(mutex_);
      commands.swap(commands_);
    }
    const std::uint64_t events = now.probe.lost + now.probe.returned + now.poses.lost + now.poses.returned;
    try {
      std::span<const ProbeSample> samples(probe_rows_);
      std::span<const TrackerSample> poses(pose_rows_);
      for (RecorderCommand& command : commands) {
        if (replayed_) command.t_ns = writer_->latest_ns();
        writer_->add(split_before(poses, command.t_ns));
        writer_->add(split_before(samples, command.t_ns));
        writer_->apply(command);
      }
      writer_->add(poses);
      writer_->add(samples);
      if (!replayed_) writer_->pass_time(host_now_ns());
      writer_->note_description(now.description);
      writer_->set_problems(sensor_problems(now));
      if (events != events_) writer_->note_change();
      events_ = events;
      if (const auto info = writer_->commit()) info_writer_->put(*info);
      // The first thing that the disk refuses ends the take: what was written before it is whole.
      if (const std::string refused = info_writer_->failure(); !refused.empty()) throw Error(refused);
      if (last) info_writer_.reset();
      if (last) writer_->finish();
    } catch (const std::exception& error) {
      failure_ = error.what();
    }
  }

  void publish(RecorderSnapshot now) {
    writer_->describe(now);
    if (now.pose) now.pose_age_s = seconds(host_now_ns() - now.pose->t_ns);
    for (BodySnapshot& body : now.bodies) {
      if (body.pose) body.pose_age_s = seconds(host_now_ns() - body.pose->t_ns);
    }
    now.highest_write_s = highest_write_s_;
    now.failure = failure_.empty() ? refused_besides_ : failure_;
    const std::lock_guard lock(snapshot_mutex_);
    snapshot_ = std::move(now);
  }

  RecorderConfig config_;
  bool replayed_;
  std::function<std::string()> failure_besides_;
  std::int64_t start_ns_;
  std::optional<ProbeThread> probe_;
  std::optional<PoseThread> poses_;
  std::optional<RecordingWriter> writer_;
  std::optional<RecordingInfoWriter> info_writer_;  // gone once the last recording.json is to be written

  std::vector<ProbeSample> probe_rows_;
  std::vector<TrackerSample> pose_rows_;
  RateMeter probe_rate_;
  RateMeter pose_rate_;
  double highest_write_s_ = 0.0;
  std::uint64_t events_ = 0;     // sensors lost and returned
  std::string failure_;          // of the recording: nothing more is written to it
  std::string refused_besides_;  // of what is written besides it

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::vector<RecorderCommand> commands_;
  mutable std::mutex snapshot_mutex_;
  RecorderSnapshot snapshot_;
  std::thread thread_;
};

Recorder::Recorder(const fs::path& folder, const RecordingInfo& info, const std::optional<Calibration>& calibration,
                   RecorderSensors sensors, const RecorderConfig& config)
    : parts_(std::make_unique<Parts>(folder, info, calibration, std::move(sensors), config)) {}

Recorder::~Recorder() = default;

void Recorder::start_segment(std::string name) { parts_->ask(RecorderCommand::Kind::kStart, std::move(name)); }
void Recorder::stop_segment() { parts_->ask(RecorderCommand::Kind::kStop, ""); }
void Recorder::discard_segment() { parts_->ask(RecorderCommand::Kind::kDiscard, ""); }
void Recorder::rescan_segment() { parts_->ask(RecorderCommand::Kind::kRescan, ""); }
void Recorder::restore_segment() { parts_->ask(RecorderCommand::Kind::kRestore, ""); }
void Recorder::set_mode(StoreMode mode) {
  parts_->ask(mode == StoreMode::kAuto ? RecorderCommand::Kind::kByContact : RecorderCommand::Kind::kByHand, "");
}

RecorderSnapshot Recorder::snapshot() const { return parts_->snapshot(); }
RecorderSnapshot Recorder::finish() { return parts_->finish(); }

}  // namespace asperity
