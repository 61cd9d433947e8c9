#ifndef ASPERITY_FIRMWARE_ICM42688_MODEL_H
#define ASPERITY_FIRMWARE_ICM42688_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The ICM-42688-P's registers, FIFO and interrupt as its datasheet (DS-000347) has them, for tests of the driver: on
// the host and linked into the firmware under an emulator. Integers only, no memory but its own.

#define ASP_ICM42688_MODEL_BANKS 3u
#define ASP_ICM42688_MODEL_FIFO 128u  // packets

// What the host's end of the bus sees of the sensor's data line.
typedef enum { ASP_MODEL_LINE_WORKS, ASP_MODEL_LINE_LOW, ASP_MODEL_LINE_HIGH } asp_model_line;

typedef struct {
  // The world.
  uint32_t period_ns;
  void* context;  // of the functions below
  void (*row)(void* context, uint64_t n, int16_t accel[3], int16_t gyro[3]);
  void (*interrupt)(void* context, uint64_t time_ns);  // a pulse of INT1; NULL: not connected
  void (*byte_time)(void* context);                    // time passes for a byte of the bus; NULL: none

  // Faults.
  uint8_t identity;  // 47h is this sensor's
  bool bus_works;    // false: transfers are refused
  asp_model_line line;
  int32_t stuck_bank;  // with stuck_address: a register that cannot be written; −1: none
  int32_t stuck_address;
  bool resets;
  uint64_t invalid_from;  // rows [from, to) are marked as invalid
  uint64_t invalid_to;
  uint32_t lose_bytes;  // of the FIFO's: the next packets are out of step

  // State.
  uint64_t now_ns;
  uint64_t next_row_ns;  // while it runs
  uint64_t rows_made;
  bool running;
  uint8_t bank;
  uint8_t registers[ASP_ICM42688_MODEL_BANKS][128];
  uint8_t fifo[ASP_ICM42688_MODEL_FIFO][16];
  uint32_t fifo_first;
  uint32_t fifo_count;
  uint32_t in_packet;
} asp_icm42688_model;

// Switched on at now_ns, without a fault; the world's functions are to be set then.
void asp_icm42688_model_init(asp_icm42688_model* model, uint32_t period_ns, uint64_t now_ns);

// The supply was gone: registers, FIFO and bank as after switching on.
void asp_icm42688_model_power_cycle(asp_icm42688_model* model);

// Makes the rows up to now_ns. Earlier times than before do nothing.
void asp_icm42688_model_advance_to(asp_icm42688_model* model, uint64_t now_ns);

// When row `n` was or will be taken, if the sensor runs without a break.
uint64_t asp_icm42688_model_row_ns(const asp_icm42688_model* model, uint64_t n);

// For asp_spi.transfer.
bool asp_icm42688_model_transfer(asp_icm42688_model* model, const uint8_t* out, uint8_t* in, size_t count);

#ifdef __cplusplus
}
#endif

#endif
