#include "scan/bench_source.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/camera/open_y4m.h"
#include "asperity/link/probe_link.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/simulation/live_bench.h"
#include "asperity/tracking/camera_pose_source.h"
#include "asperity/transport/byte_source.h"
#include "asperity/transport/open_serial.h"
#include "scan/episodes.h"
#include "temporary_folder.h"

namespace asperity::studio {

namespace {

constexpr int kBaud = 921'600;  // a pseudo-terminal does not mind

// Where the bench can be read while it plays.
struct Ports {
  std::string probe, camera;
};
using BenchStage = Episodes<Ports>;

// A sensor of the bench: there while it plays, silent in between. `Source` is ProbeSource or PoseSource.
template <class Source>
class BenchLink {
 public:
  using Open = std::function<std::unique_ptr<Source>(const Ports&)>;
  BenchLink(std::shared_ptr<BenchStage> stage, Open open) : stage_(std::move(stage)), open_(std::move(open)) {}

  // The source of the episode that plays; null if none began within `timeout`.
  Source* wait(std::chrono::milliseconds timeout) {
    if (source_) return source_.get();
    const auto episode = stage_->wait_newer(number_, timeout);
    if (!episode) return nullptr;
    number_ = episode->number;
    try {
      source_ = open_(episode->what);
    } catch (const Error&) {
      // Told to stop before it was opened.
    }
    return source_.get();
  }
  Source* now() const { return source_.get(); }
  void close() { source_.reset(); }

 private:
  std::shared_ptr<BenchStage> stage_;
  Open open_;
  std::uint64_t number_ = 0;
  std::unique_ptr<Source> source_;
};

class BenchProbe : public ProbeSource {
 public:
  explicit BenchProbe(BenchLink<ProbeSource> link) : link_(std::move(link)) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    ProbeSource* source = link_.wait(timeout);
    if (source == nullptr) return;
    try {
      source->read(out, timeout);
      if (auto known = source->description()) description_ = std::move(known);
    } catch (const LinkLost&) {
      before_ += source->statistics();
      link_.close();
    }
  }
  LinkStatistics statistics() const override {
    LinkStatistics out = before_;
    if (const ProbeSource* source = link_.now()) out += source->statistics();
    return out;
  }
  std::optional<ProbeDescription> description() const override { return description_; }
  std::string name() const override { return "the bench"; }

 private:
  BenchLink<ProbeSource> link_;
  LinkStatistics before_;
  std::optional<ProbeDescription> description_;
};

class BenchPoses : public PoseSource {
 public:
  BenchPoses(BenchLink<PoseSource> link, double rate_Hz) : link_(std::move(link)), rate_Hz_(rate_Hz) {}

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    PoseSource* source = link_.wait(timeout);
    if (source == nullptr) return std::nullopt;
    try {
      return source->read(timeout);
    } catch (const LinkLost&) {
      before_ += source->statistics();
      link_.close();
      return std::nullopt;
    }
  }
  TrackingStatistics statistics() const override {
    TrackingStatistics out = before_;
    if (const PoseSource* source = link_.now()) out += source->statistics();
    return out;
  }
  double nominal_rate_Hz() const override { return rate_Hz_; }
  std::string name() const override { return "the bench"; }

 private:
  BenchLink<PoseSource> link_;
  double rate_Hz_;
  TrackingStatistics before_;
};

class BenchSource : public ScanSource {
 public:
  BenchSource(const BenchConfig& config, const Observer& observer)
      : live_(live_bench_of(config)),
        probe_(simulation_of(config).probe),
        recording_(simulate_live_recording(simulation_of(config), live_, observer)),
        calibration_(recording_.calibration),
        hello_(opening(recording_, config.rest_s)) {}

  ~BenchSource() override {
    {
      const std::lock_guard lock(mutex_);
      end_ = true;
    }
    stop_ = true;
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  RecorderSensors sensors(const TrackConfig& track, const std::function<void(const CameraFrame&)>& on_frame) override {
    BodyTracker(recording_.calibration.camera.value(), recording_.calibration.markers, track);  // throws now
    const ProbeProtocol protocol = probe_.model == ProbeModel::kWhat ? ProbeProtocol::kWhat : ProbeProtocol::kOpen;
    RecorderSensors out;
    out.open_probe = [stage = stage_, protocol]() -> std::unique_ptr<ProbeSource> {
      return std::make_unique<BenchProbe>(BenchLink<ProbeSource>(stage, [protocol](const Ports& ports) {
        return make_probe_source(ProbeLink(open_serial(ports.probe, kBaud), protocol));
      }));
    };
    out.open_poses = [stage = stage_, track, on_frame, rate_Hz = live_.camera.rate_Hz,
                      calibration = recording_.calibration]() -> std::unique_ptr<PoseSource> {
      const auto open = [=](const Ports& ports) {
        return make_camera_pose_source(open_y4m(ports.camera),
                                       BodyTracker(calibration.camera.value(), calibration.markers, track),
                                       {true, rate_Hz}, on_frame);
      };
      return std::make_unique<BenchPoses>(BenchLink<PoseSource>(stage, open), rate_Hz);
    };
    out.probe_describes_itself = protocol == ProbeProtocol::kOpen;
    out.reopen_probe = false;
    out.reopen_poses = false;
    wanted_ = &hello_;
    thread_ = std::thread([this] { run(); });
    return out;
  }

  const std::optional<Calibration>& calibration() const override { return calibration_; }

  RecordingInfo info() const override {
    RecordingInfo out;
    out.object = recording_.info.object;
    out.gravity_world_mps2 = recording_.info.gravity_world_mps2;
    out.simulation.emplace().is_live = true;
    return out;
  }

  void adapt(RecorderConfig& config) const override {
    constexpr double kBusyMachine_s = 20.0;
    config.describe_s = std::max(config.describe_s, kBusyMachine_s);
    config.pre_roll_s = 0.0;  // what was before is of another playing
  }

  bool plays() const override { return true; }
  void play() override {
    {
      const std::lock_guard lock(mutex_);
      wanted_ = &recording_;
      stop_ = true;
    }
    changed_.notify_all();
  }
  void stop_playing() override {
    const std::lock_guard lock(mutex_);
    wanted_ = nullptr;
    stop_ = true;
  }
  bool playing() const override {
    const std::lock_guard lock(mutex_);
    return wanted_ != nullptr || now_ == &recording_;
  }

 private:
  static Recording opening(const Recording& recording, double rest_s) {
    const std::int64_t start_ns = recording.truth.value().t_ns.front();
    return cut_recording(recording, start_ns, start_ns + std::llround(0.6e9 * rest_s));
  }

  void run() {
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        now_ = nullptr;
        changed_.wait(lock, [this] { return end_ || wanted_ != nullptr; });
        if (end_) return;
        now_ = std::exchange(wanted_, nullptr);
        stop_ = false;
      }
      try {
        Observer observer;
        observer.cancelled = [this] { return stop_.load(); };
        LiveBench bench(*now_, probe_, live_, folder_.path());
        stage_->begin({bench.port(), bench.camera()});
        if (bench.wait_for_readers(observer)) bench.play(observer);
      } catch (const Error&) {
        // Told to stop; or the system refuses, and the recorder sees that nothing comes.
      }
      stage_->end();
    }
  }

  LiveBenchConfig live_;
  SimulatedProbeConfig probe_;
  Recording recording_;
  std::optional<Calibration> calibration_;
  Recording hello_;
  TemporaryFolder folder_;
  std::shared_ptr<BenchStage> stage_ = std::make_shared<BenchStage>();
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool end_ = false;
  const Recording* wanted_ = nullptr;
  const Recording* now_ = nullptr;  // plays
  std::thread thread_;
};

}  // namespace

std::unique_ptr<ScanSource> make_bench_source(const BenchConfig& config, const Observer& observer) {
  return std::make_unique<BenchSource>(config, observer);
}

}  // namespace asperity::studio
