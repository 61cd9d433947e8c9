#include "asperity_firmware/icm42688_model.h"

#include <string.h>

enum {
  kDeviceConfig = 0x11,
  kFifoConfig = 0x16,
  kIntStatus = 0x2D,
  kFifoCountHigh = 0x2E,
  kFifoCountLow = 0x2F,
  kFifoData = 0x30,
  kSignalPathReset = 0x4B,
  kIntfConfig0 = 0x4C,
  kPwrMgmt0 = 0x4E,
  kFifoConfig1 = 0x5F,
  kFifoConfig2 = 0x60,
  kFifoConfig3 = 0x61,
  kIntSource0 = 0x65,
  kWhoAmI = 0x75,
  kBankSel = 0x76,

  kPacketBytes = 16,
  kFifoFull = 0x02,
  kResetDone = 0x10,
  kStartUp_ns = 1000000
};

// Values after a reset, of bank 0; all others are zero as far as the driver goes.
static const uint8_t kResetValues[][2] = {{kIntStatus, kResetDone},
                                          {kIntfConfig0, 0x30},
                                          {0x4D, 0x91},
                                          {0x4F, 0x06},
                                          {0x50, 0x06},
                                          {0x52, 0x11},
                                          {0x54, 0x23},
                                          {0x64, 0x10},
                                          {kIntSource0, 0x10}};

static void empty_fifo(asp_icm42688_model* model) {
  model->fifo_first = 0;
  model->fifo_count = 0;
  model->in_packet = 0;
}

void asp_icm42688_model_power_cycle(asp_icm42688_model* model) {
  memset(model->registers, 0, sizeof model->registers);
  for (size_t i = 0; i < sizeof kResetValues / sizeof kResetValues[0]; ++i) {
    model->registers[0][kResetValues[i][0]] = kResetValues[i][1];
  }
  model->bank = 0;
  model->running = false;
  empty_fifo(model);
}

void asp_icm42688_model_init(asp_icm42688_model* model, uint32_t period_ns, uint64_t now_ns) {
  memset(model, 0, sizeof *model);
  model->period_ns = period_ns;
  model->now_ns = now_ns;
  model->identity = 0x47;
  model->bus_works = true;
  model->stuck_bank = -1;
  model->stuck_address = -1;
  model->resets = true;
  asp_icm42688_model_power_cycle(model);
}

uint64_t asp_icm42688_model_row_ns(const asp_icm42688_model* model, uint64_t n) {
  return model->next_row_ns - (model->rows_made - n) * model->period_ns;
}

static void put_values(uint8_t* out, const int16_t* values, bool invalid) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const uint16_t value = invalid ? 0x8000u : (uint16_t)values[axis];
    out[2 * axis] = (uint8_t)(value >> 8);
    out[2 * axis + 1] = (uint8_t)(value & 0xFFu);
  }
}

static void queue_packet(asp_icm42688_model* model, uint64_t n) {
  uint8_t* packet = model->fifo[(model->fifo_first + model->fifo_count) % ASP_ICM42688_MODEL_FIFO];
  int16_t accel[3] = {0};
  int16_t gyro[3] = {0};
  if (model->row != NULL) {
    model->row(model->context, n, accel, gyro);
  }
  memset(packet, 0, kPacketBytes);
  packet[0] = 0x68;
  put_values(packet + 1, accel, n >= model->invalid_from && n < model->invalid_to);
  put_values(packet + 7, gyro, false);
  ++model->fifo_count;
}

// It stops when it is full.
static void make_row(asp_icm42688_model* model) {
  const uint64_t n = model->rows_made++;
  uint8_t* bank0 = model->registers[0];
  if (model->fifo_count < ASP_ICM42688_MODEL_FIFO) {
    queue_packet(model, n);
  }
  if (model->fifo_count == ASP_ICM42688_MODEL_FIFO) {
    bank0[kIntStatus] |= kFifoFull;
  }
  const uint32_t watermark = bank0[kFifoConfig2] + 256u * bank0[kFifoConfig3];
  const bool pulses = (bank0[kIntSource0] & 0x04u) != 0 && (bank0[kFifoConfig1] & 0x20u) != 0;
  if (pulses && model->fifo_count >= watermark && model->interrupt != NULL) {
    model->interrupt(model->context, model->next_row_ns);
  }
}

void asp_icm42688_model_advance_to(asp_icm42688_model* model, uint64_t now_ns) {
  if (now_ns > model->now_ns) {
    model->now_ns = now_ns;
  }
  while (model->running && model->next_row_ns <= model->now_ns) {
    make_row(model);
    model->next_row_ns += model->period_ns;
  }
}

static void next_byte(asp_icm42688_model* model) {
  ++model->in_packet;
  if (model->in_packet == kPacketBytes) {
    model->in_packet = 0;
    model->fifo_first = (model->fifo_first + 1u) % ASP_ICM42688_MODEL_FIFO;
    --model->fifo_count;
  }
}

static uint8_t read_fifo(asp_icm42688_model* model) {
  while (model->fifo_count > 0 && model->lose_bytes > 0) {
    --model->lose_bytes;
    next_byte(model);
  }
  if (model->fifo_count == 0) {
    return 0xFF;
  }
  const uint8_t byte = model->fifo[model->fifo_first][model->in_packet];
  next_byte(model);
  return byte;
}

static uint8_t read_register(asp_icm42688_model* model, uint8_t address) {
  uint8_t* bank0 = model->registers[0];
  if (address == kFifoData && model->bank == 0) {
    return read_fifo(model);
  }
  if (address == kBankSel) {
    return model->bank;
  }
  if (model->bank != 0) {
    return model->bank < ASP_ICM42688_MODEL_BANKS ? model->registers[model->bank][address] : 0;
  }
  const bool in_packets = (bank0[kIntfConfig0] & 0x40u) != 0;
  const uint32_t count = in_packets ? model->fifo_count : kPacketBytes * model->fifo_count;
  switch (address) {
    case kWhoAmI:
      return model->identity;
    case kIntStatus: {
      const uint8_t status = bank0[kIntStatus];
      bank0[kIntStatus] = 0;
      return status;
    }
    case kFifoCountHigh:
      return (uint8_t)(count >> 8);
    case kFifoCountLow:
      return (uint8_t)(count & 0xFFu);
    default:
      return bank0[address];
  }
}

// Both sensors on and the FIFO used: rows come a start-up time later, numbered on.
static void start_if_on(asp_icm42688_model* model) {
  const uint8_t* bank0 = model->registers[0];
  if (!model->running && bank0[kPwrMgmt0] == 0x0F && (bank0[kFifoConfig] & 0xC0u) != 0) {
    model->running = true;
    model->next_row_ns = model->now_ns + kStartUp_ns;
  }
}

static void write_bank0(asp_icm42688_model* model, uint8_t address, uint8_t value) {
  if (address == kDeviceConfig && (value & 1u) != 0) {
    asp_icm42688_model_power_cycle(model);
    model->registers[0][kIntStatus] = model->resets ? kResetDone : 0;
  } else if (address == kSignalPathReset) {
    if ((value & 2u) != 0) {
      empty_fifo(model);
    }
  } else {
    model->registers[0][address] = value;
    start_if_on(model);
  }
}

static void write_register(asp_icm42688_model* model, uint8_t address, uint8_t value) {
  if (address == kBankSel) {
    model->bank = value & 7u;
  } else if (model->bank == model->stuck_bank && address == model->stuck_address) {
    return;
  } else if (model->bank == 0) {
    write_bank0(model, address, value);
  } else if (model->bank < ASP_ICM42688_MODEL_BANKS) {
    model->registers[model->bank][address] = value;
  }
}

static void pass_byte(asp_icm42688_model* model) {
  if (model->byte_time != NULL) {
    model->byte_time(model->context);
  }
}

bool asp_icm42688_model_transfer(asp_icm42688_model* model, const uint8_t* out, uint8_t* in, size_t count) {
  if (!model->bus_works) {
    return false;
  }
  uint8_t address = out[0] & 0x7Fu;
  const bool reads = (out[0] & 0x80u) != 0;
  pass_byte(model);
  in[0] = 0;
  for (size_t i = 1; i < count; ++i) {
    const uint8_t given = out[i];
    if (model->line != ASP_MODEL_LINE_WORKS) {
      in[i] = model->line == ASP_MODEL_LINE_HIGH ? 0xFF : 0;
    } else if (reads) {
      in[i] = read_register(model, address);
    } else {
      in[i] = 0;
      write_register(model, address, given);
    }
    if (address != kFifoData || model->bank != 0) {
      address = (address + 1u) & 0x7Fu;
    }
    pass_byte(model);
  }
  return true;
}
