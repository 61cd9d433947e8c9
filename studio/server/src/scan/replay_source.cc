#include "scan/replay_source.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/studio/calls.h"
#include "scan/episodes.h"

namespace asperity::studio {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTogether = std::chrono::milliseconds(2);  // as a link's packets come

// The recording, and by how much its times are moved while it plays.
struct ReplayStage {
  Recording recording;
  Episodes<std::int64_t> shifts_ns;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
};

Clock::time_point as_time_point(std::int64_t host_ns) {
  return Clock::time_point(std::chrono::duration_cast<Clock::duration>(std::chrono::nanoseconds(host_ns)));
}

// How far one of the recording's streams has been read in the episode that plays.
class Cursor {
 public:
  Cursor(std::shared_ptr<ReplayStage> stage, const std::vector<std::int64_t>& t_ns)
      : stage_(std::move(stage)), t_ns_(t_ns) {}

  // The rows that are due, as soon as there are any; an empty range after `timeout`.
  struct Due {
    std::size_t begin = 0, end = 0;
    std::int64_t shift_ns = 0;
  };
  Due wait(std::chrono::milliseconds timeout) {
    const auto until = Clock::now() + timeout;
    auto episode = stage_->shifts_ns.now();
    if (!episode) episode = stage_->shifts_ns.wait_newer(number_, timeout);
    if (!episode) return {};
    if (episode->number != number_) {
      number_ = episode->number;
      next_ = 0;
    }
    const std::int64_t shift_ns = episode->what;
    const auto due_at = next_ < t_ns_.size() ? as_time_point(t_ns_[next_] + shift_ns) : until;
    stage_->shifts_ns.wait_change(number_, std::min(until, std::max(due_at, Clock::now() + kTogether)));
    const std::int64_t now_ns = host_now_ns();
    Due out{next_, next_, shift_ns};
    while (out.end < t_ns_.size() && t_ns_[out.end] + shift_ns <= now_ns) ++out.end;
    next_ = out.end;
    return out;
  }

 private:
  std::shared_ptr<ReplayStage> stage_;
  const std::vector<std::int64_t>& t_ns_;
  std::uint64_t number_ = 0;
  std::size_t next_ = 0;
};

class ReplayedProbe : public ProbeSource {
 public:
  explicit ReplayedProbe(std::shared_ptr<ReplayStage> stage)
      : stage_(stage), cursor_(stage, stage->recording.probe.t_ns) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    const Cursor::Due due = cursor_.wait(timeout);
    const ProbeStream& probe = stage_->recording.probe;
    for (std::size_t i = due.begin; i < due.end; ++i) {
      ProbeSample row;
      row.t_ns = probe.t_ns[i] + due.shift_ns;
      row.accel_counts = probe.accel_counts[i];
      row.force_counts = probe.force_counts[i];
      if (probe.has_gyro()) row.gyro_counts = probe.gyro_counts[i];
      if (!probe.force3_counts.empty()) row.force3_counts = probe.force3_counts[i];
      out.push_back(row);
    }
    statistics_.samples += due.end - due.begin;
  }

  LinkStatistics statistics() const override { return statistics_; }

  std::optional<ProbeDescription> description() const override {
    const RecordingInfo& info = stage_->recording.info;
    ProbeDescription out;
    out.model = info.probe_model;
    out.rate_Hz = info.probe_rate_Hz;
    out.adc_min = info.adc_min;
    out.adc_max = info.adc_max;
    out.has_gyro = stage_->recording.probe.has_gyro();
    out.force_axes = stage_->recording.probe.force3_counts.empty() ? 1 : 3;
    return out;
  }

  std::string name() const override { return "a recording"; }

 private:
  std::shared_ptr<ReplayStage> stage_;
  Cursor cursor_;
  LinkStatistics statistics_;
};

class ReplayedPoses : public PoseSource {
 public:
  explicit ReplayedPoses(std::shared_ptr<ReplayStage> stage)
      : stage_(stage), cursor_(stage, stage->recording.tracker.t_ns) {}

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (next_ == due_.end) {
      due_ = cursor_.wait(timeout);
      next_ = due_.begin;
    }
    if (next_ == due_.end) return std::nullopt;
    const TrackerStream& tracker = stage_->recording.tracker;
    TrackedPose out;
    out.sample.t_ns = tracker.t_ns[next_] + due_.shift_ns;
    out.sample.T_world_marker = tracker.T_world_marker[next_];
    if (!tracker.markers.empty()) out.sample.markers = tracker.markers[next_];
    if (!tracker.reprojection_px.empty()) out.sample.reprojection_px = tracker.reprojection_px[next_];
    ++next_;
    ++statistics_.frames;
    ++statistics_.poses;
    return out;
  }

  TrackingStatistics statistics() const override { return statistics_; }
  double nominal_rate_Hz() const override { return stage_->recording.info.tracker_rate_Hz; }
  std::string name() const override { return "a recording"; }

 private:
  std::shared_ptr<ReplayStage> stage_;
  Cursor cursor_;
  Cursor::Due due_;
  std::size_t next_ = 0;
  TrackingStatistics statistics_;
};

class ReplaySource : public ScanSource {
 public:
  explicit ReplaySource(Recording recording) : stage_(std::make_shared<ReplayStage>()) {
    if (recording.probe.size() == 0) {
      throw Advice("the recording has no samples of the probe to replay",
                   "Choose another recording, or all of it instead of a segment.");
    }
    if (!recording.calibration.uncalibrated) calibration_ = recording.calibration;
    stage_->recording = std::move(recording);
    const auto span = [this](const std::vector<std::int64_t>& t_ns) {
      if (t_ns.empty()) return;
      stage_->first_ns = std::min(stage_->first_ns, t_ns.front());
      stage_->last_ns = std::max(stage_->last_ns, t_ns.back());
    };
    stage_->first_ns = stage_->last_ns = stage_->recording.probe.t_ns.front();
    span(stage_->recording.probe.t_ns);
    span(stage_->recording.tracker.t_ns);
  }

  RecorderSensors sensors(const TrackConfig&, const std::function<void(const CameraFrame&)>&) override {
    RecorderSensors out;
    out.open_probe = [stage = stage_] { return std::make_unique<ReplayedProbe>(stage); };
    if (stage_->recording.tracker.size() > 0)
      out.open_poses = [stage = stage_] { return std::make_unique<ReplayedPoses>(stage); };
    out.reopen_probe = false;
    out.reopen_poses = false;
    return out;
  }

  const std::optional<Calibration>& calibration() const override { return calibration_; }

  RecordingInfo info() const override {
    RecordingInfo out;
    out.object = stage_->recording.info.object;
    out.world = stage_->recording.info.world;
    out.gravity_world_mps2 = stage_->recording.info.gravity_world_mps2;
    out.is_replayed = true;
    return out;
  }

  // Nothing is before its first row.
  void adapt(RecorderConfig& config) const override { config.pre_roll_s = 0.0; }

  bool plays() const override { return true; }
  void play() override {
    constexpr std::int64_t kSoon_ns = 20'000'000;
    stage_->shifts_ns.begin(host_now_ns() + kSoon_ns - stage_->first_ns);
  }
  void stop_playing() override { stage_->shifts_ns.end(); }
  bool playing() const override {
    const auto episode = stage_->shifts_ns.now();
    return episode && host_now_ns() <= stage_->last_ns + episode->what;
  }

 private:
  std::shared_ptr<ReplayStage> stage_;
  std::optional<Calibration> calibration_;
};

}  // namespace

std::unique_ptr<ScanSource> make_replay_source(Recording recording) {
  return std::make_unique<ReplaySource>(std::move(recording));
}

}  // namespace asperity::studio
