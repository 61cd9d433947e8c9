#include "asperity_firmware/sensors.h"

static uint8_t imu_state(asp_icm42688_status status) {
  static const uint8_t kStates[] = {ASP_SENSOR_WORKS, ASP_SENSOR_BUS_FAILS, ASP_SENSOR_NOT_FOUND, ASP_SENSOR_NO_RESET,
                                    ASP_SENSOR_NOT_AS_WRITTEN};
  return kStates[status];
}

static uint8_t force_state(asp_ads1220_status status) {
  static const uint8_t kStates[] = {ASP_SENSOR_WORKS, ASP_SENSOR_BUS_FAILS, ASP_SENSOR_NOT_AS_WRITTEN};
  return kStates[status];
}

static void add_imu_counts(const asp_icm42688_statistics* statistics, asp_faults* faults) {
  faults->counts[ASP_FAULTS_IMU_BUS_FAILURES] += statistics->bus_failures;
  faults->counts[ASP_FAULTS_IMU_OVERFLOWS] += statistics->overflows;
  faults->counts[ASP_FAULTS_IMU_LOST_SYNC] += statistics->lost_sync;
  faults->counts[ASP_FAULTS_IMU_INVALID_ROWS] += statistics->invalid_rows;
}

static void add_force_counts(const asp_ads1220* force, asp_faults* faults) {
  faults->counts[ASP_FAULTS_FORCE_BUS_FAILURES] += force->bus_failures;
  faults->counts[ASP_FAULTS_FORCE_SKIPPED] += force->skipped;
}

static void start_imu(asp_sensors* sensors, uint64_t now_us) {
  sensors->faults.imu_state = imu_state(asp_icm42688_start(&sensors->imu, sensors->imu_spi));
  sensors->imu_due_us = now_us + ASP_RETRY_US;
}

static void start_force(asp_sensors* sensors, uint64_t now_us) {
  sensors->faults.force_state =
      force_state(asp_ads1220_start(&sensors->force, sensors->force_spi, sensors->force_rate));
  sensors->force_due_us = now_us + ASP_RETRY_US;
}

// Started once more, a sensor works when it has given something.
static uint8_t restarted(uint8_t state) { return state == ASP_SENSOR_WORKS ? ASP_SENSOR_NO_SAMPLES : state; }

static bool is_read(uint8_t state) { return state == ASP_SENSOR_WORKS || state == ASP_SENSOR_NO_SAMPLES; }

void asp_sensors_start(asp_sensors* sensors, const asp_spi* imu_spi, const asp_spi* force_spi,
                       asp_ads1220_rate force_rate, uint64_t now_us) {
  *sensors = (asp_sensors){.imu_spi = imu_spi, .force_spi = force_spi, .force_rate = force_rate};
  start_imu(sensors, now_us);
  if (force_spi != NULL) {
    start_force(sensors, now_us);
  }
}

// Rows that the sensor made, or would have made, while it was started again are counted by time when the next come.
static void restart_imu(asp_sensors* sensors, uint64_t now_us) {
  const asp_icm42688 before = sensors->imu;
  add_imu_counts(&before.statistics, &sensors->faults);
  ++sensors->faults.counts[ASP_FAULTS_IMU_RESTARTS];
  start_imu(sensors, now_us);
  sensors->faults.imu_state = restarted(sensors->faults.imu_state);
  asp_icm42688_continue(&sensors->imu, &before);
}

size_t asp_sensors_read_imu(asp_sensors* sensors, uint64_t now_us, asp_imu_row* rows, size_t capacity) {
  if (now_us >= sensors->imu_due_us) {
    restart_imu(sensors, now_us);
    return 0;
  }
  if (!is_read(sensors->faults.imu_state)) {
    return 0;
  }
  const size_t count = asp_icm42688_read(&sensors->imu, rows, capacity);
  if (count > 0) {
    sensors->faults.imu_state = ASP_SENSOR_WORKS;
    sensors->imu_due_us = now_us + ASP_IMU_SILENCE_US;
  }
  return count;
}

bool asp_sensors_read_force(asp_sensors* sensors, uint64_t now_us, asp_force_sample* sample) {
  if (sensors->force_spi == NULL) {
    return false;
  }
  if (now_us >= sensors->force_due_us) {
    add_force_counts(&sensors->force, &sensors->faults);
    ++sensors->faults.counts[ASP_FAULTS_FORCE_RESTARTS];
    start_force(sensors, now_us);
    sensors->faults.force_state = restarted(sensors->faults.force_state);
    return false;
  }
  if (!is_read(sensors->faults.force_state) || !asp_ads1220_read(&sensors->force, sample)) {
    return false;
  }
  sensors->faults.force_state = ASP_SENSOR_WORKS;
  sensors->force_due_us = now_us + ASP_FORCE_SILENCE_US;
  return true;
}

void asp_sensors_read_faults(const asp_sensors* sensors, asp_faults* faults) {
  *faults = sensors->faults;
  add_imu_counts(&sensors->imu.statistics, faults);
  if (sensors->force_spi != NULL) {
    add_force_counts(&sensors->force, faults);
  }
}
