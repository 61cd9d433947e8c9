#include "faults_frame.h"

enum { kPause_us = 100000 };

static bool same_faults(const asp_faults* a, const asp_faults* b) {
  bool same = a->imu_state == b->imu_state && a->force_state == b->force_state;
  for (unsigned i = 0; i < ASP_FAULTS_COUNTS; ++i) {
    same = same && a->counts[i] == b->counts[i];
  }
  return same;
}

static bool faults_are_due(const asp_probe* probe, const asp_faults* faults, uint64_t now_us) {
  static const asp_faults kNone = {0};
  return !same_faults(faults, &probe->faults) || (now_us >= probe->faults_repeat_us && !same_faults(faults, &kNone));
}

bool asp_make_faults_frame(asp_probe* probe, uint64_t now_us) {
  if (probe->board->read_faults == NULL || now_us < probe->faults_due_us) {
    return false;
  }
  probe->faults_due_us = now_us + kPause_us;
  asp_faults faults = {0};
  probe->board->read_faults(probe->board->context, &faults);
  if (!faults_are_due(probe, &faults, now_us)) {
    return false;
  }
  probe->faults = faults;
  probe->faults_repeat_us = now_us + probe->config.description_period_us;
  asp_frame_writer writer;
  asp_frame_begin(&writer, probe->line, sizeof probe->line);
  asp_frame_put_u8(&writer, ASP_PROTOCOL_VERSION);
  asp_frame_put_u8(&writer, ASP_TYPE_FAULTS);
  asp_frame_put_u8(&writer, faults.imu_state);
  asp_frame_put_u8(&writer, faults.force_state);
  for (unsigned i = 0; i < ASP_FAULTS_COUNTS; ++i) {
    asp_frame_put_u32(&writer, faults.counts[i]);
  }
  probe->line_size = (uint32_t)asp_frame_end(&writer);
  probe->line_sent = 0;
  ++probe->statistics.faults;
  return true;
}
