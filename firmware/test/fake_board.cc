#include "fake_board.h"

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

std::uint64_t mix(std::uint64_t n) {
  n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9u;
  n = (n ^ (n >> 27)) * 0x94D049BB133111EBu;
  return n ^ (n >> 31);
}

}  // namespace

reference::Row fake_row(std::uint64_t n) {
  if (n % 97 == 0) return {{-32768, 32767, 0}, {0, -32768, 32767}};
  if (n % 101 == 0) return {};
  const std::uint64_t a = mix(2 * n);
  const std::uint64_t b = mix(2 * n + 1);
  const auto part = [](std::uint64_t bits, int i) { return static_cast<int>((bits >> (16 * i)) & 0xFFFF) - 32768; };
  return {{part(a, 0), part(a, 1), part(a, 2)}, {part(b, 0), part(b, 1), part(b, 2)}};
}

std::array<std::int32_t, 3> fake_force(std::uint64_t n) {
  if (n % 89 == 0) return {INT32_MIN, INT32_MAX, 0};
  const auto part = [n](std::uint64_t i) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(mix(n * 3 + i)));
  };
  return {part(0), part(1), part(2)};
}

FakeBoard::FakeBoard(const Options& options) : options_(options) {
  board_ = {this, clock, read_imu, options.force_rate_Hz > 0.0 ? read_force : nullptr, write, read_host, nullptr};
}

double FakeBoard::row_time_ns(std::uint64_t n) const {
  const double even = static_cast<double>(n) * 1e9 / options_.imu_rate_Hz;
  const double jitter = options_.row_jitter_us * 1e3 * (static_cast<double>(mix(n) % 2001) / 1000.0 - 1.0);
  return static_cast<double>(options_.start_us) * 1e3 + even + jitter;
}

double FakeBoard::force_time_us(std::uint64_t n) const {
  return static_cast<double>(options_.start_us) + static_cast<double>(n) * 1e6 / options_.force_rate_Hz;
}

void FakeBoard::advance(std::uint64_t us) {
  elapsed_us_ += us;
  const auto now = static_cast<double>(now_us());
  while (options_.imu_rate_Hz > 0.0 && row_time_ns(rows_made_) * 1e-3 <= now) {
    const bool lost = losing_ > 0 || fifo_.size() == options_.fifo_rows;
    if (lost) {
      if (losing_ > 0) --losing_;
      ++lost_since_;
      ++fifo_lost_;
    } else {
      fifo_.push_back({rows_made_, lost_since_});
      lost_since_ = 0;
    }
    ++rows_made_;
  }
  while (options_.force_rate_Hz > 0.0 && force_time_us(forces_made_) <= now) forces_.push_back(forces_made_++);
  link_credit_ = std::min(link_credit_ + options_.link_bytes_per_s * static_cast<double>(us) * 1e-6, 65536.0);
  while (link_credit_ >= 1.0 && !buffer_.empty()) {
    received_.push_back(buffer_.front());
    buffer_.pop_front();
    link_credit_ -= 1.0;
  }
  if (buffer_.empty()) link_credit_ = std::min(link_credit_, 1.0);
}

std::uint64_t FakeBoard::clock(void* context) { return static_cast<FakeBoard*>(context)->now_us(); }

std::size_t FakeBoard::read_imu(void* context, asp_imu_row* rows, std::size_t capacity) {
  auto& self = *static_cast<FakeBoard*>(context);
  std::size_t count = 0;
  while (count < capacity && !self.fifo_.empty()) {
    const FifoRow next = self.fifo_.front();
    const reference::Row row = fake_row(next.number);
    asp_imu_row& out = rows[count++];
    out.lost_before = next.lost_before;
    out.time_ns = static_cast<std::uint64_t>(std::llround(self.row_time_ns(next.number)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.accel[axis] = static_cast<std::int16_t>(row.accel[axis]);
      out.gyro[axis] = static_cast<std::int16_t>(row.gyro[axis]);
    }
    self.fifo_.pop_front();
  }
  return count;
}

bool FakeBoard::read_force(void* context, asp_force_sample* sample) {
  auto& self = *static_cast<FakeBoard*>(context);
  if (self.forces_.empty()) return false;
  const std::uint64_t n = self.forces_.front();
  self.forces_.pop_front();
  sample->time_us = static_cast<std::uint64_t>(self.force_time_us(n));
  const auto counts = fake_force(n);
  std::copy(counts.begin(), counts.end(), sample->counts);
  return true;
}

std::size_t FakeBoard::write(void* context, const std::uint8_t* bytes, std::size_t count) {
  auto& self = *static_cast<FakeBoard*>(context);
  const std::size_t room = self.options_.link_buffer - self.buffer_.size();
  const std::size_t taken = self.options_.datagrams && room < count ? 0 : std::min(room, count);
  self.buffer_.insert(self.buffer_.end(), bytes, bytes + taken);
  if (taken > 0) self.writes_.push_back(taken);
  return taken;
}

std::size_t FakeBoard::read_host(void* context, std::uint8_t* bytes, std::size_t capacity) {
  auto& self = *static_cast<FakeBoard*>(context);
  const std::size_t count = std::min(capacity, self.host_.size());
  std::copy_n(self.host_.begin(), count, bytes);
  self.host_.erase(self.host_.begin(), self.host_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

}  // namespace asperity
