#include "simulated_icm42688.h"

#include "fake_board.h"

namespace asperity {

SimulatedIcm42688::SimulatedIcm42688(double period_us) : period_us_(period_us) {
  spi_ = {this, transfer, wait};
  reset();
}

void SimulatedIcm42688::reset() {
  for (auto& bank : banks_) bank.fill(0);
  auto& bank0 = banks_[0];
  bank0[0x2D] = 0x10;
  bank0[0x4C] = 0x30;
  bank0[0x4D] = 0x91;
  bank0[0x4F] = bank0[0x50] = 0x06;
  bank0[0x52] = 0x11;
  bank0[0x54] = 0x23;
  bank0[0x64] = 0x10;
  bank0[0x65] = 0x10;
  fifo_.clear();
  in_packet_ = 0;
  running_ = false;
}

void SimulatedIcm42688::advance(double us) {
  now_us_ += us;
  while (running_ && row_time_us(rows_made_) <= now_us_) make_row();
}

void SimulatedIcm42688::make_row() {
  const std::uint64_t n = rows_made_++;
  auto& bank0 = banks_[0];
  if (fifo_.size() == 128) {  // stop on full
    bank0[0x2D] |= 0x02;
  } else {
    Packet packet{};
    packet[0] = 0x68;
    const reference::Row row = fake_row(n);
    const bool invalid = n >= invalid_from && n < invalid_to;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto accel = static_cast<std::uint16_t>(invalid ? -32768 : row.accel[axis]);
      const auto gyro = static_cast<std::uint16_t>(row.gyro[axis]);
      packet[1 + 2 * axis] = static_cast<std::uint8_t>(accel >> 8);
      packet[2 + 2 * axis] = static_cast<std::uint8_t>(accel);
      packet[7 + 2 * axis] = static_cast<std::uint8_t>(gyro >> 8);
      packet[8 + 2 * axis] = static_cast<std::uint8_t>(gyro);
    }
    fifo_.push_back(packet);
    if (fifo_.size() == 128) bank0[0x2D] |= 0x02;
  }
  const std::size_t watermark = bank0[0x60] + 256u * bank0[0x61];
  if ((bank0[0x65] & 0x04) != 0 && (bank0[0x5F] & 0x20) != 0 && fifo_.size() >= watermark && on_interrupt) {
    on_interrupt(row_time_us(n));
  }
}

std::uint8_t SimulatedIcm42688::read_fifo() {
  if (fifo_.empty()) return 0xFF;
  if (lost_bytes_ > 0) {
    --lost_bytes_;
    ++in_packet_;
  }
  const std::uint8_t byte = fifo_.front()[in_packet_++];
  if (in_packet_ == 16) {
    fifo_.pop_front();
    in_packet_ = 0;
  }
  return byte;
}

std::uint8_t SimulatedIcm42688::read(int address) {
  if (address == 0x76) return static_cast<std::uint8_t>(bank_);
  if (bank_ != 0) return banks_[bank_][address];
  auto& bank0 = banks_[0];
  const bool in_records = (bank0[0x4C] & 0x40) != 0;
  const std::size_t count = in_records ? fifo_.size() : 16 * fifo_.size();
  switch (address) {
    case 0x75:
      return identity;
    case 0x2D: {
      const std::uint8_t status = bank0[0x2D];
      bank0[0x2D] = 0;
      return status;
    }
    case 0x2E:
      return static_cast<std::uint8_t>(count >> 8);
    case 0x2F:
      return static_cast<std::uint8_t>(count);
    case 0x30:
      return read_fifo();
    default:
      return bank0[address];
  }
}

void SimulatedIcm42688::write(int address, std::uint8_t value) {
  if (address == 0x76) {
    bank_ = value & 7;
    return;
  }
  if (bank_ == stuck_bank && address == stuck_address) return;
  if (bank_ == 0 && address == 0x11 && (value & 1) != 0) {
    reset();
    if (!resets) banks_[0][0x2D] = 0;
    return;
  }
  if (bank_ == 0 && address == 0x4B) {
    if ((value & 2) != 0) {
      fifo_.clear();
      in_packet_ = 0;
    }
    return;
  }
  banks_[bank_][address] = value;
  const bool on = banks_[0][0x4E] == 0x0F && (banks_[0][0x16] & 0xC0) != 0;
  if (on && !running_) {
    running_ = true;
    first_row_us_ = now_us_ + 1000.0 - period_us_ * static_cast<double>(rows_made_);
  }
}

bool SimulatedIcm42688::transfer(void* context, const std::uint8_t* out, std::uint8_t* in, std::size_t count) {
  auto& self = *static_cast<SimulatedIcm42688*>(context);
  if (!self.bus_works) return false;
  int address = out[0] & 0x7F;
  const bool reads = (out[0] & 0x80) != 0;
  self.advance(1.0);
  in[0] = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const std::uint8_t given = out[i];
    in[i] = reads ? self.read(address) : 0;
    if (!reads) self.write(address, given);
    if (address != 0x30 || self.bank_ != 0) address = (address + 1) & 0x7F;
    self.advance(1.0);
  }
  return true;
}

void SimulatedIcm42688::wait(void* context, std::uint32_t us) { static_cast<SimulatedIcm42688*>(context)->advance(us); }

}  // namespace asperity
