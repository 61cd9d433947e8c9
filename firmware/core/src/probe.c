#include "asperity_firmware/probe.h"

#include <string.h>

#include "faults_frame.h"
#include "sample_frame.h"

enum { kHostBytesAStep = 64, kFramesAStep = 8, kAskedPause_us = 100000 };

const asp_probe_config asp_default_config = {16, 10000, 1000000};

_Static_assert((ASP_ROW_QUEUE & (ASP_ROW_QUEUE - 1u)) == 0, "the queue's counters wrap at 2^32");
_Static_assert((ASP_FORCE_QUEUE & (ASP_FORCE_QUEUE - 1u)) == 0, "the queue's counters wrap at 2^32");
_Static_assert(1u + ASP_FRAME_BYTES(2u + ASP_DESCRIPTION_MAX) <= ASP_LINE_BYTES, "a description fits the line");
_Static_assert(sizeof(asp_probe) <= 12u * 1024u, "firmware/README.md states this");

bool asp_probe_init(asp_probe* probe, const asp_board* board, const asp_description* description,
                    const asp_probe_config* config) {
  // No compound literal: unoptimised, it would stand on the stack.
  memset(probe, 0, sizeof *probe);
  probe->board = board;
  probe->config = config != NULL ? *config : asp_default_config;
  probe->start = true;
  probe->has_gyro = description->has_gyro;
  probe->has_force3 = description->force_axes == 3;
  probe->description_size = (uint32_t)asp_write_description(description, probe->description, sizeof probe->description);
  probe->description_due_us = board->clock_us(board->context);
  probe->asked_due_us = probe->description_due_us;
  const asp_probe_config* c = &probe->config;
  return probe->description_size > 0 && c->rows_per_frame >= 1 && c->rows_per_frame <= ASP_MAX_ROWS &&
         c->latency_us <= 1000000u && c->description_period_us <= 2000000u;
}

static void count_lost_rows(asp_probe* probe, uint32_t lost) {
  probe->next_index += lost;
  probe->statistics.rows_dropped += lost;
}

// A row that finds the queue full is dropped, and its number with it: the host sees the gap.
static void queue_row(asp_probe* probe, const asp_imu_row* row) {
  count_lost_rows(probe, row->lost_before);
  if (probe->rows_put - probe->rows_taken == ASP_ROW_QUEUE) {
    count_lost_rows(probe, 1);
    return;
  }
  asp_queued_row* place = &probe->rows[probe->rows_put % ASP_ROW_QUEUE];
  place->time_ns = row->time_ns;
  for (unsigned axis = 0; axis < 3; ++axis) {
    place->accel[axis] = row->accel[axis];
    place->gyro[axis] = row->gyro[axis];
  }
  place->index = probe->next_index;
  ++probe->rows_put;
  ++probe->next_index;
}

static bool take_rows(asp_probe* probe) {
  bool worked = false;
  for (uint32_t reads = 0; reads < ASP_ROW_QUEUE / ASP_ROWS_A_READ; ++reads) {
    asp_imu_row rows[ASP_ROWS_A_READ];
    const size_t count = probe->board->read_imu(probe->board->context, rows, ASP_ROWS_A_READ);
    for (size_t i = 0; i < count; ++i) {
      queue_row(probe, &rows[i]);
    }
    worked = worked || count > 0;
    if (count < ASP_ROWS_A_READ) {
      break;
    }
  }
  return worked;
}

static bool take_forces(asp_probe* probe) {
  if (probe->board->read_force == NULL) {
    return false;
  }
  uint32_t taken = 0;
  asp_force_sample sample = {0};
  for (; taken < ASP_FORCE_QUEUE && probe->board->read_force(probe->board->context, &sample); ++taken) {
    if (probe->forces_put - probe->forces_taken == ASP_FORCE_QUEUE) {
      probe->force_overrun = true;
      ++probe->statistics.forces_dropped;
      continue;
    }
    probe->forces[probe->forces_put % ASP_FORCE_QUEUE] = sample;
    ++probe->forces_put;
  }
  return taken > 0;
}

static bool hear_host(asp_probe* probe) {
  if (probe->board->read_host == NULL) {
    return false;
  }
  uint8_t bytes[kHostBytesAStep];
  const size_t count = probe->board->read_host(probe->board->context, bytes, sizeof bytes);
  for (size_t i = 0; i < count; ++i) {
    if (asp_request_put(&probe->request, bytes[i])) {
      probe->asked = true;
      ++probe->statistics.requests;
    }
  }
  return count > 0;
}

// A host that asks without end must not push the samples aside: at most ten answers a second.
static bool make_description_if_due(asp_probe* probe, uint64_t now_us) {
  const bool answer = probe->asked && now_us >= probe->asked_due_us;
  if (!answer && now_us < probe->description_due_us) {
    return false;
  }
  asp_make_description_frame(probe);
  probe->asked = false;
  probe->asked_due_us = now_us + kAskedPause_us;
  probe->description_due_us = now_us + probe->config.description_period_us;
  return true;
}

static bool send(asp_probe* probe, uint64_t now_us) {
  bool worked = false;
  for (uint32_t frames = 0; frames < kFramesAStep; ++frames) {
    if (probe->line_sent < probe->line_size) {
      const size_t taken = probe->board->write(probe->board->context, probe->line + probe->line_sent,
                                               probe->line_size - probe->line_sent);
      probe->line_sent += (uint32_t)taken;
      worked = worked || taken > 0;
      if (probe->line_sent < probe->line_size) {
        return worked;
      }
    }
    if (!make_description_if_due(probe, now_us) && !asp_make_faults_frame(probe, now_us) &&
        !asp_make_sample_frame(probe, now_us)) {
      return worked;
    }
    worked = true;
  }
  return worked;
}

bool asp_probe_step(asp_probe* probe) {
  const bool heard = hear_host(probe);
  const bool moved = take_rows(probe);
  const bool pressed = take_forces(probe);
  const bool sent = send(probe, probe->board->clock_us(probe->board->context));
  return heard || moved || pressed || sent;
}
