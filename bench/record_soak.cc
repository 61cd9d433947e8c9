// The recorder under a probe of 4 kHz and poses at 120 Hz, in real time (docs/recorder.md).
//   record_soak [minutes [folder]]    fails if a sample is lost or a queue overflows
// The probe's bytes are frames of the open protocol (16 rows with gyroscope, a force sample every third), which the
// real link and decoder read; the poses are given as a tracker would.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/link/open_protocol.h"
#include "asperity/recorder/recorder.h"
#include "asperity/recording/read_recording.h"

namespace {

using namespace asperity;

constexpr std::int64_t kRow_ns = 250'000;
constexpr std::size_t kRowsPerFrame = 16;
constexpr std::int64_t kFrame_ns = kRow_ns * static_cast<std::int64_t>(kRowsPerFrame);
constexpr std::int64_t kPose_ns = 8'333'333;

// Sleeps until `t_ns`, at most `timeout`; true if it has come.
bool wait_until(std::int64_t t_ns, std::chrono::milliseconds timeout) {
  const std::int64_t wait_ns = t_ns - host_now_ns();
  if (wait_ns > 0)
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds(wait_ns), timeout));
  return host_now_ns() >= t_ns;
}

class SoakBytes : public ByteSource {
 public:
  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    if (waiting_.empty() && !wait_until(start_ns_ + kFrame_ns * (frame_ + 1), timeout)) return {};
    const std::int64_t now_ns = host_now_ns();
    if (frame_ == 0 && waiting_.empty()) describe();
    while (start_ns_ + kFrame_ns * (frame_ + 1) <= now_ns && waiting_.size() < into.size() / 2) add_frame();
    const std::size_t count = std::min(into.size(), waiting_.size());
    std::copy_n(waiting_.begin(), count, into.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    return {count, now_ns};
  }
  bool write(std::span<const std::uint8_t>) override { return false; }
  std::string name() const override { return "soak probe"; }

 private:
  void describe() {
    ProbeDescription out;
    out.model = "open";
    out.name = "soak";
    out.firmware = "0";
    out.rate_Hz = 4000.0;
    out.adc_min = -32768.0;
    out.adc_max = 32767.0;
    out.accel_counts_per_mps2 = 208.8;
    out.has_gyro = true;
    out.gyro_counts_per_radps = 939.65;
    out.force_rate_Hz = 330.0;
    append_open_description(format_open_description(out), waiting_);
  }

  void add_frame() {
    OpenSamples frame;
    frame.start = frame_ == 0;
    frame.has_gyro = true;
    frame.sequence = static_cast<std::uint32_t>(frame_);
    frame.imu_index = static_cast<std::uint32_t>(frame_ * kRowsPerFrame);
    frame.time_us = static_cast<std::uint64_t>(frame_ * kFrame_ns / 1000);
    frame.imu_period_ns = kRow_ns;
    frame.row_count = kRowsPerFrame;
    for (std::size_t i = 0; i < kRowsPerFrame; ++i) {
      const double t_s = 1e-9 * static_cast<double>(frame_ * kFrame_ns + kRow_ns * static_cast<std::int64_t>(i));
      const auto wave = static_cast<std::int16_t>(800.0 * std::sin(500.0 * t_s));
      frame.rows[i].accel = {wave, static_cast<std::int16_t>(-2048 + wave / 4), static_cast<std::int16_t>(wave / 2)};
      frame.rows[i].gyro = {wave, 0, static_cast<std::int16_t>(-wave)};
    }
    if (frame_ % 3 == 0) {
      frame.force_count = 1;
      frame.forces[0].counts[0] = 50'000 + static_cast<std::int32_t>(frame_ % 1000);
    }
    append_open_samples(frame, waiting_);
    ++frame_;
  }

  std::int64_t start_ns_ = host_now_ns();
  std::int64_t frame_ = 0;
  std::vector<std::uint8_t> waiting_;
};

class SoakPoses : public PoseSource {
 public:
  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (!wait_until(next_ns_, timeout)) return std::nullopt;
    TrackedPose out;
    const double t_s = 1e-9 * static_cast<double>(next_ns_ - start_ns_);
    out.sample.t_ns = next_ns_;
    out.sample.T_world_marker.translation_m = {0.05 * std::sin(t_s), 0.01 * std::cos(3.0 * t_s), 0.4};
    out.sample.T_world_marker.rotation = exp_rotation({0.1 * std::sin(2.0 * t_s), 0.2, 0.3});
    out.sample.markers = 4;
    out.sample.reprojection_px = 0.1;
    out.covariance = 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
    next_ns_ += kPose_ns;
    ++statistics_.frames;
    ++statistics_.poses;
    return out;
  }
  TrackingStatistics statistics() const override { return statistics_; }
  double nominal_rate_Hz() const override { return 120.0; }
  std::string name() const override { return "soak tracker"; }

 private:
  std::int64_t start_ns_ = host_now_ns();
  std::int64_t next_ns_ = start_ns_;
  TrackingStatistics statistics_;
};

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

int soak(double minutes, const std::filesystem::path& folder) {
  Calibration calibration;
  calibration.accelerometer.B = 208.8 * Eigen::Matrix3d::Identity();
  calibration.tip_in_marker_m = {0.0, 0.1, 0.0};
  RecorderConfig config;
  config.start_at_once = true;
  RecorderSensors sensors;
  sensors.open_probe = [] { return make_probe_source(ProbeLink(std::make_unique<SoakBytes>(), ProbeProtocol::kOpen)); };
  sensors.open_poses = [] { return std::make_unique<SoakPoses>(); };
  Recorder recorder(folder, {}, calibration, sensors, config);
  const double start_cpu_s = cpu_s();
  while (recorder.snapshot().running_s < 60.0 * minutes && recorder.snapshot().failure.empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const double used_s = cpu_s() - start_cpu_s;
  const RecorderSnapshot end = recorder.finish();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);

  // Every row that the probe sent is in the file: the rows are a quarter of a millisecond apart, and the time mapped.
  const Recording recording = read_recording(folder);
  double longest_s = 0.0;
  for (std::size_t i = 1; i < recording.probe.size(); ++i)
    longest_s = std::max(longest_s, 1e-9 * static_cast<double>(recording.probe.t_ns[i] - recording.probe.t_ns[i - 1]));
  const bool whole = end.link.lost_samples == 0 && end.probe.overflowed == 0 && end.poses.overflowed == 0 &&
                     recording.probe.size() == end.link.samples && recording.tracker.size() == end.tracking.poses &&
                     recording.problems.empty();
  std::printf("recorded            %10.1f s, %.1f MB\n", end.recorded_s, 1e-6 * static_cast<double>(end.disk_bytes));
  std::printf(
      "probe               %10llu samples, %llu in the file, %llu lost, %llu overflowed, longest step %.3f ms\n",
      static_cast<unsigned long long>(end.link.samples), static_cast<unsigned long long>(recording.probe.size()),
      static_cast<unsigned long long>(end.link.lost_samples), static_cast<unsigned long long>(end.probe.overflowed),
      1e3 * longest_s);
  std::printf("poses               %10llu, %llu in the file, %llu overflowed\n",
              static_cast<unsigned long long>(end.tracking.poses),
              static_cast<unsigned long long>(recording.tracker.size()),
              static_cast<unsigned long long>(end.poses.overflowed));
  std::printf("fullest queue       %10.2f %% of the probe's, %.2f %% of the poses'\n",
              100.0 * end.probe.highest_queue_fill, 100.0 * end.poses.highest_queue_fill);
  std::printf("longest write       %10.1f ms\n", 1e3 * end.highest_write_s);
  std::printf("processor           %10.1f %% of one core\n", 100.0 * used_s / end.running_s);
  std::printf("memory              %10.1f MiB at most while recording\n",
              static_cast<double>(usage.ru_maxrss) / 1024.0);
  std::printf("%s\n", whole ? "passed" : "FAILED");
  return whole ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const double minutes = argc > 1 ? std::atof(argv[1]) : 10.0;
  std::filesystem::path folder = argc > 2 ? argv[2] : "";
  std::string made;
  if (folder.empty()) {
    made = (std::filesystem::temp_directory_path() / "asperity-record-soak-XXXXXX").string();
    if (mkdtemp(made.data()) == nullptr) return 1;
    folder = std::filesystem::path(made) / "recording";
  }
  int code = 1;
  try {
    code = soak(minutes, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "record_soak: %s\n", error.what());
  }
  std::error_code ignored;
  if (!made.empty()) std::filesystem::remove_all(made, ignored);
  return code;
}
