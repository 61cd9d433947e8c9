#include "sample_frame.h"

enum { kFlagStart = 1, kFlagOverrun = 2, kFlagGyro = 4, kFlagForce3 = 8 };

static const asp_queued_row* asp_row_at(const asp_probe* probe, uint32_t i) {
  return &probe->rows[(probe->rows_taken + i) % ASP_ROW_QUEUE];
}

static const asp_force_sample* asp_force_at(const asp_probe* probe, uint32_t i) {
  return &probe->forces[(probe->forces_taken + i) % ASP_FORCE_QUEUE];
}

// Rows at the front of the queue that one frame can hold: numbered one after another and evenly spaced, so that a
// time and a period say when each was. Spacings within a quarter of the first count as even: what is left is the
// clock's reading, not a missing row. `run_ended`: a row that does not belong follows.
static uint32_t count_run(const asp_probe* probe, bool* run_ended) {
  const uint32_t waiting = probe->rows_put - probe->rows_taken;
  const uint32_t most = waiting < probe->config.rows_per_frame ? waiting : probe->config.rows_per_frame;
  uint64_t spacing_ns = 0;
  *run_ended = false;
  for (uint32_t i = 1; i < most; ++i) {
    const asp_queued_row* before = asp_row_at(probe, i - 1);
    const asp_queued_row* row = asp_row_at(probe, i);
    const uint64_t step_ns = row->time_ns - before->time_ns;
    if (i == 1) {
      spacing_ns = step_ns;
    }
    const uint64_t off_ns = step_ns > spacing_ns ? step_ns - spacing_ns : spacing_ns - step_ns;
    if (row->index != before->index + 1u || row->time_ns <= before->time_ns || step_ns > UINT32_MAX ||
        off_ns > spacing_ns / 4u) {
      *run_ended = true;
      return i;
    }
  }
  return most;
}

static bool is_old(const asp_probe* probe, uint64_t now_us, uint64_t sample_us) {
  return now_us >= sample_us && now_us - sample_us >= probe->config.latency_us;
}

static bool is_due(const asp_probe* probe, uint64_t now_us, uint32_t rows, bool run_ended) {
  const uint32_t forces = probe->forces_put - probe->forces_taken;
  return rows >= probe->config.rows_per_frame || run_ended || forces >= ASP_MAX_FORCES ||
         (rows > 0 && is_old(probe, now_us, asp_row_at(probe, 0)->time_ns / 1000u)) ||
         (forces > 0 && is_old(probe, now_us, asp_force_at(probe, 0)->time_us));
}

static bool fits_offset(uint64_t time_us, uint64_t sample_us) {
  return sample_us >= time_us ? sample_us - time_us <= INT32_MAX : time_us - sample_us <= INT32_MAX;
}

static uint32_t offset_bits(uint64_t time_us, uint64_t sample_us) {
  return (uint32_t)((sample_us - time_us) & 0xFFFFFFFFu);
}

static uint32_t count_forces(const asp_probe* probe, uint64_t time_us) {
  const uint32_t waiting = probe->forces_put - probe->forces_taken;
  const uint32_t most = waiting < ASP_MAX_FORCES ? waiting : ASP_MAX_FORCES;
  uint32_t count = 0;
  while (count < most && fits_offset(time_us, asp_force_at(probe, count)->time_us)) {
    ++count;
  }
  return count;
}

static uint32_t period_ns(const asp_probe* probe, uint32_t rows) {
  if (rows < 2) {
    return 0;
  }
  const uint64_t span_ns = asp_row_at(probe, rows - 1)->time_ns - asp_row_at(probe, 0)->time_ns;
  return (uint32_t)((span_ns + (rows - 1u) / 2u) / (rows - 1u));
}

static void put_rows(asp_frame_writer* writer, asp_probe* probe, uint32_t rows) {
  for (uint32_t i = 0; i < rows; ++i) {
    const asp_queued_row* row = asp_row_at(probe, i);
    for (unsigned axis = 0; axis < 3; ++axis) {
      asp_frame_put_u16(writer, (uint16_t)row->accel[axis]);
    }
    for (unsigned axis = 0; probe->has_gyro && axis < 3; ++axis) {
      asp_frame_put_u16(writer, (uint16_t)row->gyro[axis]);
    }
  }
}

static void put_forces(asp_frame_writer* writer, asp_probe* probe, uint32_t forces, uint64_t time_us) {
  for (uint32_t i = 0; i < forces; ++i) {
    const asp_force_sample* sample = asp_force_at(probe, i);
    asp_frame_put_u32(writer, offset_bits(time_us, sample->time_us));
    for (unsigned axis = 0; axis < (probe->has_force3 ? 3u : 1u); ++axis) {
      asp_frame_put_u32(writer, (uint32_t)sample->counts[axis]);
    }
  }
}

bool asp_make_sample_frame(asp_probe* probe, uint64_t now_us) {
  bool run_ended = false;
  uint32_t rows = count_run(probe, &run_ended);
  if (!is_due(probe, now_us, rows, run_ended)) {
    return false;
  }
  const uint32_t index = rows > 0 ? asp_row_at(probe, 0)->index : probe->next_index;
  const uint64_t time_us = rows > 0 ? asp_row_at(probe, 0)->time_ns / 1000u : asp_force_at(probe, 0)->time_us;
  const uint32_t forces = count_forces(probe, time_us);
  const bool overrun = probe->force_overrun || index != probe->expected_index;

  asp_frame_writer writer;
  asp_frame_begin(&writer, probe->line, sizeof probe->line);
  asp_frame_put_u8(&writer, ASP_PROTOCOL_VERSION);
  asp_frame_put_u8(&writer, ASP_TYPE_SAMPLES);
  asp_frame_put_u8(&writer, (uint8_t)((probe->start ? kFlagStart : 0) | (overrun ? kFlagOverrun : 0) |
                                      (probe->has_gyro ? kFlagGyro : 0) | (probe->has_force3 ? kFlagForce3 : 0)));
  asp_frame_put_u8(&writer, (uint8_t)rows);
  asp_frame_put_u8(&writer, (uint8_t)forces);
  asp_frame_put_u8(&writer, 0);
  asp_frame_put_u16(&writer, 0);
  asp_frame_put_u32(&writer, probe->sequence);
  asp_frame_put_u32(&writer, index);
  asp_frame_put_u64(&writer, time_us);
  asp_frame_put_u32(&writer, period_ns(probe, rows));
  put_rows(&writer, probe, rows);
  put_forces(&writer, probe, forces, time_us);
  probe->line_size = (uint32_t)asp_frame_end(&writer);
  probe->line_sent = 0;

  probe->rows_taken += rows;
  probe->forces_taken += forces;
  probe->expected_index = index + rows;
  ++probe->sequence;
  ++probe->statistics.sample_frames;
  probe->start = false;
  probe->force_overrun = false;
  return true;
}

// The first frame of all is a description: a zero byte before it ends what noise or a boot loader's text began.
void asp_make_description_frame(asp_probe* probe) {
  asp_frame_writer writer;
  probe->line[0] = 0;
  asp_frame_begin(&writer, probe->line + 1, sizeof probe->line - 1);
  asp_frame_put_u8(&writer, ASP_PROTOCOL_VERSION);
  asp_frame_put_u8(&writer, ASP_TYPE_DESCRIPTION);
  asp_frame_put_bytes(&writer, probe->description, probe->description_size);
  probe->line_size = 1u + (uint32_t)asp_frame_end(&writer);
  probe->line_sent = 0;
  ++probe->statistics.descriptions;
}
