#include "live_rig.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "asperity/base/host_clock.h"
#include "asperity/link/open_protocol.h"
#include "run_asperity.h"

namespace asperity::cli {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kRowsPerFrame = 10;
constexpr std::chrono::milliseconds kFrame{10};
constexpr int kFramesPerDescription = 50;

void append_description(std::vector<std::uint8_t>& out) {
  ProbeDescription probe;
  probe.model = "open";
  probe.name = "live rig";
  probe.firmware = "1";
  probe.rate_Hz = 1000.0;
  probe.adc_min = -32768.0;
  probe.adc_max = 32767.0;
  probe.accel_counts_per_mps2 = 100.0;
  probe.force_rate_Hz = 1000.0;
  append_open_description(format_open_description(probe), out);
}

void add_frame(std::int64_t tick, std::int64_t number, long force_counts, std::vector<std::uint8_t>& out) {
  OpenSamples samples;
  samples.start = number == 0;
  samples.sequence = static_cast<std::uint32_t>(number);
  samples.imu_index = static_cast<std::uint32_t>(number) * kRowsPerFrame;
  samples.time_us = static_cast<std::uint64_t>(tick) * 10'000;
  samples.imu_period_ns = 1'000'000;
  samples.row_count = kRowsPerFrame;
  samples.force_count = kRowsPerFrame;
  for (std::size_t i = 0; i < kRowsPerFrame; ++i) {
    samples.rows[i].accel = {static_cast<std::int16_t>(number % 2), -981, static_cast<std::int16_t>(i % 2)};
    samples.forces[i].offset_us = static_cast<std::int32_t>(1000 * i);
    samples.forces[i].counts[0] = static_cast<std::int32_t>(force_counts);
  }
  append_open_samples(samples, out);
}

}  // namespace

LiveProbe::LiveProbe() {
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("pty");
  port_ = ::ptsname(master_);
  // Opened and closed again: from now on the master tells whether somebody has the port.
  const int port = ::open(port_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios raw{};
  ::tcgetattr(port, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(port, TCSANOW, &raw);
  ::close(port);
  thread_ = std::thread([this] { run(); });
}

LiveProbe::~LiveProbe() {
  stop_ = true;
  thread_.join();
  ::close(master_);
}

bool LiveProbe::press(double force_N, int frames, const std::atomic<bool>& done) {
  force_counts_ = 100.0 * force_N;
  const std::int64_t last = frames_ + 1 + frames;  // the next one may have been made with the force of before
  while (frames_ < last && !done) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return !done;
}

void LiveProbe::run() {
  const Clock::time_point start = Clock::now();
  std::vector<std::uint8_t> bytes;  // that wait to be sent: the line of a busy host is full, and nothing is lost
  std::int64_t sent = 0;
  for (std::int64_t tick = 1; !stop_; ++tick) {
    std::this_thread::sleep_until(start + kFrame * tick);
    pollfd port{master_, POLLIN, 0};
    if (::poll(&port, 1, 0) < 0 || (port.revents & POLLHUP) != 0) {
      sent = 0;  // nobody is there: whoever comes finds a probe that begins
      bytes.clear();
      continue;
    }
    if (sent % kFramesPerDescription == 0) append_description(bytes);
    add_frame(tick, sent++, std::lround(force_counts_.load()), bytes);
    ++frames_;
    const ssize_t written = ::write(master_, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.erase(bytes.begin(), bytes.begin() + written);
      delivered_ns_ = host_now_ns();
    }
    std::array<char, 256> heard;
    while (::read(master_, heard.data(), heard.size()) > 0) {
    }
  }
}

LivePoses::LivePoses(const std::filesystem::path& fifo) {
  if (::mkfifo(fifo.c_str(), 0600) != 0) throw std::runtime_error("mkfifo");
  // Open for both, so that opening waits for nobody and the reader may come and go.
  file_ = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) throw std::runtime_error("fifo");
  thread_ = std::thread([this] { run(); });
}

LivePoses::~LivePoses() {
  stop_ = true;
  thread_.join();
  ::close(file_);
}

void LivePoses::run() {
  const Clock::time_point start = Clock::now();
  constexpr std::string_view kLine = ",0.01,0.02,0.4,1,0,0,0,2,0.1\n";
  for (int i = 0; !stop_; ++i) {
    std::this_thread::sleep_until(start + std::chrono::milliseconds(10) * (i + 1));
    if (::write(file_, kLine.data(), kLine.size()) < 0) {
      std::array<char, 65536> old;
      if (::read(file_, old.data(), old.size()) < 0) return;
    }
  }
}

void write_live_calibration(const std::filesystem::path& path) {
  write_text(path, R"({"format":"asperity-calibration","version":1,
 "accelerometer":{"model":"linear","B":[[100,0,0],[0,100,0],[0,0,100]],"C":[0,0,0],"residual_counts":[1,1,1]},
 "force":{"newton_per_count":0.01,"offset_newton":0,"residual_newton":0.01},
 "tip_in_marker_m":[0,0.1,0],"tip_radius_m":0.0003,
 "tracker":{"sigma_position_m":[0.0002,0.0002,0.0005],"sigma_rotation_rad":[0.003,0.003,0.003],"latency_s":0,"latency_sigma_s":0.005}}
)");
}

}  // namespace asperity::cli
