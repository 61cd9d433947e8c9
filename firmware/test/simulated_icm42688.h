#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "asperity_firmware/spi.h"

namespace asperity {

// The sensor's registers, FIFO and interrupt as its datasheet has them, behind an SPI on which a byte takes 1 µs: rows
// come while the driver reads. Row n has the values of fake_row(n).
class SimulatedIcm42688 {
 public:
  explicit SimulatedIcm42688(double period_us = 250.0);
  SimulatedIcm42688(const SimulatedIcm42688&) = delete;
  SimulatedIcm42688& operator=(const SimulatedIcm42688&) = delete;

  const asp_spi* spi() const { return &spi_; }
  void advance(double us);
  double now_us() const { return now_us_; }

  std::function<void(double now_us)> on_interrupt;
  std::uint64_t rows_made() const { return rows_made_; }
  double row_time_us(std::uint64_t n) const { return first_row_us_ + period_us_ * static_cast<double>(n); }
  std::uint8_t reg(int bank, int address) const { return banks_[bank][address]; }
  std::size_t fifo_rows() const { return fifo_.size(); }

  // Faults.
  std::uint8_t identity = 0x47;
  bool bus_works = true;
  int stuck_bank = -1;  // with stuck_address: a register that cannot be written
  int stuck_address = -1;
  bool resets = true;
  std::uint64_t invalid_from = 0;  // rows [from, to) are marked as invalid
  std::uint64_t invalid_to = 0;
  void lose_a_byte() { lost_bytes_ = 1; }  // of the FIFO's: the next packets are out of step

 private:
  using Packet = std::array<std::uint8_t, 16>;
  static bool transfer(void* context, const std::uint8_t* out, std::uint8_t* in, std::size_t count);
  static void wait(void* context, std::uint32_t us);
  void reset();
  void make_row();
  std::uint8_t read(int address);
  std::uint8_t read_fifo();
  void write(int address, std::uint8_t value);

  asp_spi spi_{};
  double period_us_;
  double now_us_ = 5000.0;
  double first_row_us_ = 0.0;
  bool running_ = false;
  std::uint64_t rows_made_ = 0;
  int bank_ = 0;
  std::array<std::array<std::uint8_t, 128>, 5> banks_{};
  std::deque<Packet> fifo_;
  std::size_t in_packet_ = 0;
  int lost_bytes_ = 0;
};

}  // namespace asperity
