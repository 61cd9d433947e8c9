#ifndef ASPERITY_FIRMWARE_BOARD_H
#define ASPERITY_FIRMWARE_BOARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "asperity_firmware/faults.h"

#ifdef __cplusplus
extern "C" {
#endif

// A row of the inertial sensor. Without a gyroscope its values are not sent.
typedef struct {
  uint64_t time_ns;  // on the clock of asp_board.clock_us, rising from row to row
  int16_t accel[3];  // raw counts along i, j, k
  int16_t gyro[3];
  uint32_t lost_before;  // rows that the sensor made but that were lost just before this one
} asp_imu_row;

typedef struct {
  uint64_t time_us;   // middle of the conversion
  int32_t counts[3];  // one axis: the first; three: the third is along the probe's axis
} asp_force_sample;

// Rows for which the core asks at a time.
#define ASP_ROWS_A_READ 16u

// What the core needs of the hardware. No function may wait, except to start a failed sensor again. All are called from
// asp_probe_step() only.
typedef struct {
  void* context;  // handed to each

  // Starts anywhere, never steps back (asp_clock64 makes one of a 32-bit counter).
  uint64_t (*clock_us)(void* context);

  // Up to `capacity` of the rows that have not been read, oldest first. Fewer than `capacity`: no more for now.
  size_t (*read_imu)(void* context, asp_imu_row* rows, size_t capacity);

  // The next conversion of the force sensor; false if there is none. NULL: no such sensor.
  bool (*read_force)(void* context, asp_force_sample* sample);

  // Takes up to `count` bytes for the host, returns how many. `bytes` is what is left of one frame: a datagram link
  // takes all or none, and so sends whole frames.
  size_t (*write)(void* context, const uint8_t* bytes, size_t count);

  // Up to `capacity` bytes from the host. NULL: no way back.
  size_t (*read_host)(void* context, uint8_t* bytes, size_t capacity);

  // The sensors' states and counts, asked for ten times a second. NULL: they are not reported.
  void (*read_faults)(void* context, asp_faults* faults);
} asp_board;

#ifdef __cplusplus
}
#endif

#endif
