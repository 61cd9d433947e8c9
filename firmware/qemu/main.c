// The probe's program on an emulated board: as on any other, with the sensors' register models behind its buses. Its
// arguments, by semihosting: the name, seconds, scenario (clean, faults, absent). At the end it prints what it did.
#include <string.h>

#include "asperity_firmware/probe.h"
#include "asperity_firmware/sensors.h"
#include "machine.h"
#include "measure.h"
#include "semihost.h"
#include "start.h"
#include "world.h"

enum {
  kBufferBytes = 256,  // what a board's buffer for the UART holds
  kRoomAUs_q10 = 94,   // 91,797 B/s: qemu's UART has no rate, 921,600 bps carry 92,160
  kDrain_us = 100000,  // until what waits has been sent
  kArgumentsBytes = 64
};

static asp_probe s_probe;
static asp_sensors s_sensors;
static uint32_t s_room_q10;
static uint64_t s_room_us;
static uint32_t s_bytes;
static measured s_steps;
static measured s_link;
static uint32_t s_longest_own;
static uint64_t s_first_row_ns;
static uint64_t s_last_row_ns;

static uint64_t clock_us(void* context) {
  (void)context;
  return world_us();
}

static size_t read_imu(void* context, asp_imu_row* rows, size_t capacity) {
  (void)context;
  const size_t count = asp_sensors_read_imu(&s_sensors, world_us(), rows, capacity);
  if (count > 0) {
    s_first_row_ns = s_first_row_ns == 0 ? rows[0].time_ns : s_first_row_ns;
    s_last_row_ns = rows[count - 1].time_ns;
  }
  return count;
}

static bool read_force(void* context, asp_force_sample* sample) {
  (void)context;
  return asp_sensors_read_force(&s_sensors, world_us(), sample);
}

static void make_room(void) {
  const uint64_t now_us = world_us();
  const uint64_t passed_us = now_us - s_room_us;
  const uint32_t most_q10 = kBufferBytes * 1024u;
  s_room_us = now_us;
  s_room_q10 += passed_us < 10000u ? (uint32_t)passed_us * kRoomAUs_q10 : most_q10;
  s_room_q10 = s_room_q10 < most_q10 ? s_room_q10 : most_q10;
}

static size_t put_bytes(const uint8_t* bytes, size_t count) {
  size_t taken = 0;
  while (taken < count && s_room_q10 >= 1024u) {
    const uint8_t damage = world_damaged_bytes() > 0 ? 0x10 : 0;
    if (!machine_uart_put(bytes[taken] ^ damage)) {
      break;
    }
    s_room_q10 -= 1024u;
    ++taken;
  }
  s_bytes += (uint32_t)taken;
  return taken;
}

static size_t write_host(void* context, const uint8_t* bytes, size_t count) {
  (void)context;
  const measure_mark begin = measure_begin();
  make_room();
  const size_t taken = put_bytes(bytes, count);
  measure_end(&s_link, begin);
  return taken;
}

static size_t read_host(void* context, uint8_t* bytes, size_t capacity) {
  (void)context;
  size_t count = 0;
  while (count < capacity && machine_uart_get(&bytes[count])) {
    ++count;
  }
  return count;
}

static void read_faults(void* context, asp_faults* faults) {
  (void)context;
  asp_sensors_read_faults(&s_sensors, faults);
}

static const asp_board kBoard = {NULL, clock_us, read_imu, read_force, write_host, read_host, read_faults};

static const asp_description kDescription = {
    .name = "qemu",
    .firmware = "1.0.0",
    .rate_hz = 4000,
    .adc_min = -32768,
    .adc_max = 32767,
    .accel_counts_per_mps2 = ASP_ICM42688_COUNTS_PER_G / 9.80665,
    .has_gyro = true,
    .gyro_counts_per_radps = ASP_ICM42688_COUNTS_PER_DEG_PER_S * 57.29577951308232,
    .force_axes = 1,
    .force_rate_hz = 660,
    .force_newton_per_count = 1e-6};

static void run_until(uint64_t end_us) {
  while (world_us() < end_us) {
    const uint32_t stall_us = world_stall_us();
    if (stall_us > 0) {
      world_spin_us(stall_us);
    }
    world_wait();
    const uint64_t before = s_steps.ticks - world_bus.ticks - s_link.ticks;
    const measure_mark begin = measure_begin();
    asp_probe_step(&s_probe);
    measure_end(&s_steps, begin);
    const uint32_t own = (uint32_t)(s_steps.ticks - world_bus.ticks - s_link.ticks - before);
    s_longest_own = own > s_longest_own ? own : s_longest_own;
  }
}

static void print_measured(const char* name, const measured* what) {
  semihost_write(name);
  semihost_write_number("_ticks", what->ticks);
  semihost_write(name);
  semihost_write_number("_count", what->count);
  semihost_write(name);
  semihost_write_number("_longest", what->longest);
}

static void print_faults(void) {
  static const char* const kNames[ASP_FAULTS_COUNTS] = {"imu_bus_failures", "imu_overflows", "imu_lost_sync",
                                                        "imu_invalid_rows", "imu_restarts",  "force_bus_failures",
                                                        "force_skipped",    "force_restarts"};
  asp_faults faults = {0};
  asp_sensors_read_faults(&s_sensors, &faults);
  semihost_write_number("imu_state", faults.imu_state);
  semihost_write_number("force_state", faults.force_state);
  for (unsigned i = 0; i < ASP_FAULTS_COUNTS; ++i) {
    semihost_write_number(kNames[i], faults.counts[i]);
  }
}

static void print_all(uint32_t stack_used) {
  semihost_write_number("rows_made", world_imu.rows_made);
  semihost_write_number("rows_numbered", s_probe.next_index);
  semihost_write_number("rows_dropped", s_probe.statistics.rows_dropped);
  semihost_write_number("rows_waiting", s_probe.rows_put - s_probe.rows_taken);
  semihost_write_number("rows_span_ns", s_last_row_ns - s_first_row_ns);
  semihost_write_number("conversions_made", world_conversions);
  semihost_write_number("forces_sent", s_probe.forces_taken);
  semihost_write_number("forces_dropped", s_probe.statistics.forces_dropped);
  semihost_write_number("frames", s_probe.statistics.sample_frames);
  semihost_write_number("requests", s_probe.statistics.requests);
  semihost_write_number("bytes", s_bytes);
  semihost_write_number("coasted_reads", s_sensors.imu.statistics.coasted_reads);
  print_faults();
  semihost_write_number("stack_used", stack_used);
  semihost_write_number("stack_size", start_stack_size());
  semihost_write_number("probe_state", sizeof s_probe);
  semihost_write_number("sensors_state", sizeof s_sensors);
  semihost_write_number("tick_ps", machine_tick_ps);
  semihost_write_number("measure_own_q6", measure_own_q6);
  semihost_write_number("measure_outer_q6", measure_outer_q6);
  print_measured("step", &s_steps);
  semihost_write_number("step_longest_own", s_longest_own);
  print_measured("link", &s_link);
  print_measured("bus", &world_bus);
}

static uint32_t parse_seconds(const char* text) {
  uint32_t value = 0;
  for (; *text >= '0' && *text <= '9'; ++text) {
    value = 10u * value + (uint32_t)(*text - '0');
  }
  return value;
}

// "NAME SECONDS SCENARIO"
static bool parse_arguments(uint32_t* seconds, world_scenario* scenario) {
  static char text[kArgumentsBytes];
  semihost_arguments(text, sizeof text);
  const char* first = strchr(text, ' ');
  const char* second = first != NULL ? strchr(first + 1, ' ') : NULL;
  if (second == NULL) {
    return false;
  }
  *seconds = parse_seconds(first + 1);
  const char* name = second + 1;
  *scenario = strcmp(name, "faults") == 0 ? WORLD_FAULTS : strcmp(name, "absent") == 0 ? WORLD_ABSENT : WORLD_CLEAN;
  return *seconds > 0;
}

int main(void) {
  uint32_t seconds = 0;
  world_scenario scenario = WORLD_CLEAN;
  if (!parse_arguments(&seconds, &scenario)) {
    semihost_write("probe: give seconds and a scenario: clean, faults or absent\n");
    return 2;
  }
  machine_init();
  measure_calibrate();
  world_start(&s_sensors, scenario);
  asp_sensors_start(&s_sensors, &world_imu_spi, &world_force_spi, ASP_ADS1220_660_SPS, world_us());
  if (!asp_probe_init(&s_probe, &kBoard, &kDescription, NULL)) {
    semihost_write("probe: a setting is out of its range\n");
    return 2;
  }
  world_bus = (measured){0};
  const uint64_t end_us = world_us() + seconds * UINT64_C(1000000);
  run_until(end_us);
  world_stop();
  run_until(end_us + kDrain_us);
  print_all(start_stack_used());
  return 0;
}
