#include "world.h"

#include "asperity_firmware/clock.h"
#include "machine.h"
#include "scenario.h"

#define WORLD __attribute__((section(".world")))

enum { kTurn_us = 1000 };

WORLD asp_icm42688_model world_imu;
WORLD asp_ads1220_model world_force;
WORLD uint32_t world_conversions;
WORLD measured world_bus;
WORLD static asp_sensors* s_sensors;
WORLD static asp_clock64 s_clock;
WORLD static uint64_t s_next_conversion_ns;
WORLD static uint32_t s_next_turn_us;
WORLD static bool s_on;
WORLD static scenario_state s_scenario;
WORLD static volatile bool s_wake;
WORLD static volatile uint32_t s_stall_us;
WORLD static volatile uint32_t s_damage;

uint64_t world_us(void) {
  const uint32_t before = machine_lock();
  const uint64_t now_us = asp_clock64_extend(&s_clock, machine_us());
  machine_unlock(before);
  return now_us;
}

// Counting numbers, and a third that no neighbour has: the host can see each row's number, and a byte that is wrong.
static void put_row(void* context, uint64_t n, int16_t accel[3], int16_t gyro[3]) {
  (void)context;
  const uint32_t number = (uint32_t)n;
  const uint32_t mixed = number * 2654435761u;
  accel[0] = (int16_t)(uint16_t)(number & 0xFFFFu);
  accel[1] = (int16_t)(uint16_t)(number >> 16);
  accel[2] = (int16_t)(uint16_t)(mixed >> 16);
  gyro[0] = (int16_t)(uint16_t)(mixed & 0xFFFFu);
  gyro[1] = 0;
  gyro[2] = -1;
}

static void on_row_pulse(void* context, uint64_t time_ns) {
  (void)context;
  (void)time_ns;
  asp_edge_fire(&s_sensors->imu.edge, world_us());
  s_wake = true;
}

static void on_byte(void* context);

static void convert(uint64_t now_ns) {
  while (now_ns >= s_next_conversion_ns) {
    s_next_conversion_ns += WORLD_CONVERSION_NS;
    if (asp_ads1220_model_finish(&world_force, (int32_t)(world_conversions & 0x3FFFFFu) - 0x200000)) {
      ++world_conversions;
      asp_edge_fire(&s_sensors->force.edge, world_us());
      s_wake = true;
    }
  }
}

static void advance(uint64_t now_us) {
  asp_icm42688_model_advance_to(&world_imu, now_us * 1000u);
  convert(now_us * 1000u);
}

static uint32_t next_event_us(uint64_t now_us) {
  uint64_t next_ns = s_next_conversion_ns;
  if (world_imu.running && world_imu.next_row_ns < next_ns) {
    next_ns = world_imu.next_row_ns;
  }
  // Never farther than a conversion's time. A division of 64 bits costs an M0 more than all else here.
  const uint32_t in_ns = (uint32_t)(next_ns - now_us * 1000u);
  const uint32_t in_us = (uint32_t)(((uint64_t)in_ns * 67109u) >> 26) + 1u;
  const uint32_t next_us = (uint32_t)now_us + in_us;
  return (int32_t)(s_next_turn_us - next_us) < 0 ? s_next_turn_us : next_us;
}

void machine_on_alarm(void) {
  const uint32_t entered = measure_enter();
  const uint64_t now_us = world_us();
  if (s_on) {
    const scenario_effects effects = scenario_advance(&s_scenario, now_us, &world_imu, &world_force);
    s_stall_us += effects.stall_us;
    s_damage += effects.damaged_bytes;
    advance(now_us);
  }
  if ((int32_t)((uint32_t)now_us - s_next_turn_us) >= 0) {
    s_next_turn_us = (uint32_t)now_us + kTurn_us;
    s_wake = true;
  }
  machine_set_alarm(s_on ? next_event_us(now_us) : s_next_turn_us);
  measure_leave(entered);
}

// Called within a transfer, which keeps interrupts off but for these moments.
static void on_byte(void* context) {
  (void)context;
  machine_unlock(0);
  (void)machine_lock();
}

static bool transfer_imu(void* context, const uint8_t* out, uint8_t* in, size_t count) {
  (void)context;
  const measure_mark begin = measure_begin();
  const uint32_t before = machine_lock();
  const bool sound = asp_icm42688_model_transfer(&world_imu, out, in, count);
  machine_unlock(before);
  measure_end(&world_bus, begin);
  return sound;
}

static bool transfer_force(void* context, const uint8_t* out, uint8_t* in, size_t count) {
  (void)context;
  const measure_mark begin = measure_begin();
  const uint32_t before = machine_lock();
  const bool sound = asp_ads1220_model_transfer(&world_force, out, in, count);
  machine_unlock(before);
  measure_end(&world_bus, begin);
  return sound;
}

static void wait_us(void* context, uint32_t us) {
  (void)context;
  world_spin_us(us);
}

const asp_spi world_imu_spi = {NULL, transfer_imu, wait_us};
const asp_spi world_force_spi = {NULL, transfer_force, wait_us};

void world_spin_us(uint32_t us) {
  const uint32_t begin = machine_us();
  // Reading a device is what an emulator is slow at.
  while (machine_us() - begin < us) {
    for (volatile uint32_t i = 0; i < 64; ++i) {
    }
  }
}

// A loop that does not sleep: the emulator's time is then that of the instructions alone.
void world_wait(void) {
  while (!s_wake) {
  }
  s_wake = false;
}

static uint32_t take(volatile uint32_t* value) {
  const uint32_t before = machine_lock();
  const uint32_t taken = *value;
  *value = 0;
  machine_unlock(before);
  return taken;
}

uint32_t world_stall_us(void) { return s_stall_us > 0 ? take(&s_stall_us) : 0; }

uint32_t world_damaged_bytes(void) { return s_damage > 0 ? take(&s_damage) : 0; }

void world_start(asp_sensors* sensors, world_scenario scenario) {
  const uint64_t now_us = world_us();
  s_sensors = sensors;
  asp_icm42688_model_init(&world_imu, WORLD_ROW_NS, now_us * 1000u);
  asp_ads1220_model_init(&world_force);
  world_imu.row = put_row;
  world_imu.interrupt = on_row_pulse;
  world_imu.byte_time = on_byte;
  s_next_conversion_ns = now_us * 1000u + WORLD_CONVERSION_NS;
  s_next_turn_us = (uint32_t)now_us + kTurn_us;
  scenario_begin(&s_scenario, scenario, now_us, &world_imu);
  s_on = true;
  machine_set_alarm(s_next_turn_us);
}

void world_stop(void) { s_on = false; }
