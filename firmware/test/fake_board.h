#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "asperity_firmware/board.h"
#include "reference_decoder.h"

namespace asperity {

// Row n of the fake sensor, from its number alone: the extremes are among them.
reference::Row fake_row(std::uint64_t n);
std::array<std::int32_t, 3> fake_force(std::uint64_t n);

// Hardware that is simulated with its own clock: an inertial sensor with a FIFO, a force sensor with one register,
// and a link that carries so many bytes a second out of a small buffer. Nothing moves but in advance().
class FakeBoard {
 public:
  struct Options {
    double imu_rate_Hz = 4000.0;  // 0: none
    std::size_t fifo_rows = 128;
    double force_rate_Hz = 1000.0;  // 0: none
    double link_bytes_per_s = 92160.0;
    std::size_t link_buffer = 256;
    bool datagrams = false;         // all of a frame or nothing
    std::uint64_t start_us = 1000;  // of the clock
    double row_jitter_us = 0.0;     // ± about the even grid
  };

  explicit FakeBoard(const Options& options);
  FakeBoard(const FakeBoard&) = delete;
  FakeBoard& operator=(const FakeBoard&) = delete;

  const asp_board* board() const { return &board_; }
  void advance(std::uint64_t us);
  void set_link_speed(double bytes_per_s) { options_.link_bytes_per_s = bytes_per_s; }
  void send_from_host(const std::vector<std::uint8_t>& bytes) { host_.insert(host_.end(), bytes.begin(), bytes.end()); }
  void make_sensor_lose(std::uint32_t rows) { losing_ += rows; }

  std::uint64_t now_us() const { return options_.start_us + elapsed_us_; }
  std::uint64_t rows_made() const { return rows_made_; }  // taken by the sensor, those lost included
  std::uint64_t forces_made() const { return forces_made_; }
  std::uint64_t fifo_lost() const { return fifo_lost_; }
  double row_time_ns(std::uint64_t n) const;
  double force_time_us(std::uint64_t n) const;
  const std::vector<std::uint8_t>& received() const { return received_; }  // by the host
  const std::vector<std::size_t>& writes() const { return writes_; }       // sizes taken

 private:
  struct FifoRow {
    std::uint64_t number;
    std::uint32_t lost_before;
  };

  static std::uint64_t clock(void* context);
  static std::size_t read_imu(void* context, asp_imu_row* rows, std::size_t capacity);
  static bool read_force(void* context, asp_force_sample* sample);
  static std::size_t write(void* context, const std::uint8_t* bytes, std::size_t count);
  static std::size_t read_host(void* context, std::uint8_t* bytes, std::size_t capacity);

  Options options_;
  asp_board board_{};
  std::uint64_t elapsed_us_ = 0;
  std::deque<FifoRow> fifo_;
  std::uint64_t rows_made_ = 0;
  std::uint64_t forces_made_ = 0;
  std::uint64_t fifo_lost_ = 0;
  std::uint32_t lost_since_ = 0;
  std::uint32_t losing_ = 0;
  std::deque<std::uint64_t> forces_;
  double link_credit_ = 0.0;
  std::deque<std::uint8_t> buffer_;
  std::vector<std::uint8_t> received_;
  std::vector<std::size_t> writes_;
  std::deque<std::uint8_t> host_;
};

}  // namespace asperity
