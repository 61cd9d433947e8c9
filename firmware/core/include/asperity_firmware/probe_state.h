#ifndef ASPERITY_FIRMWARE_PROBE_STATE_H
#define ASPERITY_FIRMWARE_PROBE_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "asperity_firmware/board.h"
#include "asperity_firmware/description.h"
#include "asperity_firmware/frame.h"
#include "asperity_firmware/request.h"

#define ASP_MAX_ROWS 64u    // in a frame, by the protocol
#define ASP_MAX_FORCES 16u  // in a frame, by the protocol

// The longest frame, and the zero byte before a description.
#define ASP_LINE_BYTES (1u + ASP_FRAME_BYTES(28u + ASP_MAX_ROWS * 12u + ASP_MAX_FORCES * 16u))

// Powers of two. 256 rows are 64 ms at 4 kHz: how long the link may stall without a loss.
#define ASP_ROW_QUEUE 256u
#define ASP_FORCE_QUEUE 128u

typedef struct {
  uint32_t rows_per_frame;         // 1 to 64: a frame is sent as soon as it has so many
  uint32_t latency_us;             // or as soon as its oldest sample is so old
  uint32_t description_period_us;  // at most 2 s, by the protocol
} asp_probe_config;

typedef struct {
  uint32_t sample_frames;
  uint32_t descriptions;
  uint32_t rows_dropped;    // by the sensor, or as the queue was full
  uint32_t forces_dropped;  // as the queue was full
  uint32_t requests;
  uint32_t faults;  // frames of them
} asp_probe_statistics;

typedef struct {
  uint64_t time_ns;
  int16_t accel[3];
  int16_t gyro[3];
  uint32_t index;  // counts every row taken, also those dropped
} asp_queued_row;

// All state of a probe; no other memory is used. To be put into static memory. Members are for the core and its tests.
typedef struct {
  const asp_board* board;
  asp_probe_config config;
  bool has_gyro;
  bool has_force3;

  asp_queued_row rows[ASP_ROW_QUEUE];
  uint32_t rows_put;  // free-running: the queue holds rows_put − rows_taken
  uint32_t rows_taken;
  asp_force_sample forces[ASP_FORCE_QUEUE];
  uint32_t forces_put;
  uint32_t forces_taken;

  uint32_t next_index;      // of the next row that the sensor gives
  uint32_t expected_index;  // of the next row that is sent, if none was dropped
  uint32_t sequence;        // of the next sample frame
  bool start;               // no sample frame has been made yet
  bool force_overrun;       // force samples were dropped since the last sample frame

  uint8_t description[ASP_DESCRIPTION_MAX];
  uint32_t description_size;
  uint64_t description_due_us;
  uint64_t asked_due_us;  // no earlier than this after the last one
  bool asked;
  asp_request_reader request;

  asp_faults faults;  // as last sent
  uint64_t faults_due_us;
  uint64_t faults_repeat_us;

  uint8_t line[ASP_LINE_BYTES];  // the frame under way
  uint32_t line_size;
  uint32_t line_sent;
  asp_probe_statistics statistics;
} asp_probe;

#endif
