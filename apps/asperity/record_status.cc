#include "record_status.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "asperity/base/text.h"
#include "command.h"

namespace asperity::app {

namespace {

std::string rate_text(const char* what, const SensorSnapshot& sensor) {
  switch (sensor.state) {
    case SensorState::kAbsent:
      return "";
    case SensorState::kSilent:
      return fmt::format("  {} silent", what);
    case SensorState::kLost:
      return fmt::format("  {} LOST", what);
    case SensorState::kEnded:
      return fmt::format("  {} at its end", what);
    case SensorState::kRunning:
      break;
  }
  return fmt::format("  {} {:.0f}/s", what, sensor.rate_Hz);
}

// What is said once is not said again with another count.
std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

// As much of the line as the terminal has columns for, or it could not be written over.
std::string fitting(const std::string& line) {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return line;
  std::size_t columns = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins_a_character = (static_cast<unsigned char>(line[i]) & 0xC0u) != 0x80u;
    if (begins_a_character && ++columns >= size.ws_col) return line.substr(0, i);
  }
  return line;
}

}  // namespace

std::string record_line(const RecorderSnapshot& now) {
  std::string out = fmt::format("{:6.1f} s  ", now.recorded_s);
  out += now.storing ? "● " + printable(now.segment, 30) : fmt::format("○ {} segments", now.segments);
  out += rate_text("probe", now.probe);
  if (now.link.lost_samples > 0) out += fmt::format(" {} lost", now.link.lost_samples);
  if (now.link.faults.imu_state != 0 || now.link.faults.force_state != 0) out += " SENSOR FAULT";
  out += rate_text("poses", now.poses);
  if (now.pose && now.poses.state == SensorState::kRunning && now.pose->markers > 0)
    out += fmt::format(" {} markers", now.pose->markers);
  if (now.poses.state == SensorState::kRunning && now.pose_age_s > 0.5) out += " NOT SEEN";
  for (const BodySnapshot& body : now.bodies) {
    if (now.poses.state != SensorState::kRunning) break;
    out += "  " + body.name + (body.pose_age_s <= 0.5 ? fmt::format(" {} markers", body.pose->markers) : " NOT SEEN");
  }
  if (std::isfinite(now.force_N))
    out += now.force_is_calibrated ? fmt::format("  {:5.2f} N", now.force_N) : fmt::format("  {:.0f}", now.force_N);
  if (now.touching) out += " touching";
  if (!now.gravity.measured && now.poses.state == SensorState::kRunning)
    out += "  hold the probe still to measure gravity";
  const double fill = std::max(now.probe.queue_fill, now.poses.queue_fill);
  if (fill > 0.1) out += fmt::format("  queue {:.0f} %", 100.0 * fill);
  if (now.probe.overflowed + now.poses.overflowed > 0) out += " OVERFLOWED";
  return out + fmt::format("  {:.1f} MB", static_cast<double>(now.disk_bytes) * 1e-6);
}

RecordStatus::RecordStatus(bool quiet, bool says_keys) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {
  if (!quiet_ && says_keys)
    print_error("space: start or stop a segment, d: discard, r: discard and scan again, q: end");
}

RecordStatus::~RecordStatus() { clear(); }

void RecordStatus::clear() {
  if (visible_) std::fputs("\r\033[K", stderr);
  visible_ = false;
}

void RecordStatus::print_line(const std::string& text) {
  clear();
  print_error(text);
}

void RecordStatus::print_changes(const char* what, const SensorSnapshot& now, SensorSnapshot& before) {
  if (now.lost > before.lost) print_line(fmt::format("{} lost: {}", what, printable(now.message, 300)));
  if (now.returned > before.returned) print_line(fmt::format("{} was found again", what));
  for (const std::string& warning : now.warnings) {
    if (printed_.insert(without_digits(warning)).second) print_line(printable(warning, 300));
  }
  before = now;
}

void RecordStatus::show(const RecorderSnapshot& now) {
  using namespace std::chrono_literals;
  print_changes("the probe", now.probe, probe_);
  print_changes("the tracker", now.poses, poses_);
  if (!(now.link.faults == faults_)) {
    faults_ = now.link.faults;
    const std::string text = describe_faults(faults_);
    if (printed_.insert(without_digits(text)).second) print_line("the probe reports: " + text);
  }
  if (quiet_ || Clock::now() < next_) return;
  next_ = Clock::now() + (terminal_ ? Clock::duration(200ms) : Clock::duration(2s));
  const std::string line = record_line(now);
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s", fitting(line).c_str());
    std::fflush(stderr);
    visible_ = true;
  } else {
    print_error(line);
  }
}

}  // namespace asperity::app
