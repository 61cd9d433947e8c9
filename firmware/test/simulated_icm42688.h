#pragma once

#include <cstdint>
#include <functional>

#include "asperity_firmware/icm42688_model.h"
#include "asperity_firmware/spi.h"

namespace asperity {

// The register model behind an SPI on which a byte takes 1 µs: rows come while the driver reads. Row n has the values
// of fake_row(n).
class SimulatedIcm42688 {
 public:
  explicit SimulatedIcm42688(double period_us = 250.0);
  SimulatedIcm42688(const SimulatedIcm42688&) = delete;
  SimulatedIcm42688& operator=(const SimulatedIcm42688&) = delete;

  const asp_spi* spi() const { return &spi_; }
  void advance(double us);
  double now_us() const { return 1e-3 * static_cast<double>(model_.now_ns); }

  std::function<void(double now_us)> on_interrupt;
  std::uint64_t rows_made() const { return model_.rows_made; }
  double row_time_us(std::uint64_t n) const {
    return 1e-3 * static_cast<double>(asp_icm42688_model_row_ns(&model_, n));
  }
  std::uint8_t reg(int bank, int address) const { return model_.registers[bank][address]; }
  std::size_t fifo_rows() const { return model_.fifo_count; }
  void power_cycle() { asp_icm42688_model_power_cycle(&model_); }

 private:
  asp_icm42688_model model_{};
  asp_spi spi_{};

 public:
  // Faults.
  std::uint8_t& identity = model_.identity;
  bool& bus_works = model_.bus_works;
  asp_model_line& line = model_.line;
  std::int32_t& stuck_bank = model_.stuck_bank;  // with stuck_address: a register that cannot be written
  std::int32_t& stuck_address = model_.stuck_address;
  bool& resets = model_.resets;
  std::uint64_t& invalid_from = model_.invalid_from;  // rows [from, to) are marked as invalid
  std::uint64_t& invalid_to = model_.invalid_to;
  void lose_a_byte() { model_.lose_bytes = 1; }  // of the FIFO's: the next packets are out of step
};

}  // namespace asperity
