// The open probe on an ESP32. Not tested on hardware.
#include "asperity_firmware/ads1220.h"
#include "asperity_firmware/icm42688.h"
#include "asperity_firmware/probe.h"
#include "driver/gpio.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"
#include "link.h"
#include "pins.h"
#include "sdkconfig.h"
#include "sensors.h"

static asp_probe s_probe;
static asp_board s_board;

#ifdef CONFIG_PROBE_LINK_UDP
static const asp_board kBoard = {NULL,           sensors_clock_us, sensors_read_imu,   NULL,
                                 link_udp_write, link_udp_read,    sensors_read_faults};
static bool start_link(void) { return link_udp_start(); }
#else
static const asp_board kBoard = {
    NULL, sensors_clock_us, sensors_read_imu, NULL, link_serial_write, link_serial_read, sensors_read_faults};
static bool start_link(void) { return link_serial_start(); }
#endif

// The bridge gives `output` V per V of its supply at the rated load, which is the converter's reference too.
static double newton_per_count(void) {
  const double rated_N = CONFIG_PROBE_LOAD_CELL_MILLINEWTON * 1e-3;
  const double output = CONFIG_PROBE_LOAD_CELL_MICROVOLT_PER_VOLT * 1e-6;
  return rated_N / (output * 128.0 * 8388608.0);
}

static asp_description describe(void) {
  return (asp_description){.name = CONFIG_PROBE_NAME,
                           .firmware = "esp32 1.0.0",
                           .rate_hz = 1e9 / ASP_ICM42688_PERIOD_NS,
                           .adc_min = -32768,
                           .adc_max = 32767,
                           .accel_counts_per_mps2 = ASP_ICM42688_COUNTS_PER_G / 9.80665,
                           .has_gyro = true,
                           .gyro_counts_per_radps = ASP_ICM42688_COUNTS_PER_DEG_PER_S * 57.29577951308232,
                           .force_axes = 1,
                           .force_rate_hz = sensors_have_force() ? asp_ads1220_rate_sps(ASP_ADS1220_660_SPS) : 0,
                           .force_newton_per_count = newton_per_count()};
}

// Blinks `count` times and pauses, for ever: 1 link, 2 sensors, 3 settings.
static void stop_with(int count) {
  gpio_set_direction(kPinLed, GPIO_MODE_OUTPUT);
  for (;;) {
    for (int i = 0; i < 2 * count; ++i) {
      gpio_set_level(kPinLed, i % 2 == 0);
      vTaskDelay(pdMS_TO_TICKS(200));
    }
    vTaskDelay(pdMS_TO_TICKS(1000));
  }
}

static void run(void* context) {
  (void)context;
  bool sensors = false;
  for (int attempt = 0; attempt < 10 && !sensors; ++attempt) {
    sensors = sensors_start(xTaskGetCurrentTaskHandle());
    vTaskDelay(pdMS_TO_TICKS(100));
  }
  if (!sensors) {
    stop_with(2);
  }
  s_board = kBoard;
  s_board.read_force = sensors_have_force() ? sensors_read_force : NULL;
  const asp_description description = describe();
  if (!asp_probe_init(&s_probe, &s_board, &description, NULL)) {
    stop_with(3);
  }
  for (;;) {
    // Woken by an interrupt of a sensor, or after a tick for what the link could not take.
    ulTaskNotifyTake(pdTRUE, 1);
    asp_probe_step(&s_probe);
  }
}

void app_main(void) {
  if (!start_link()) {
    stop_with(1);
  }
  // Core 1: Wi-Fi has core 0. Interrupts are handled on the core that asked for them.
  xTaskCreatePinnedToCore(run, "probe", 8192, NULL, 10, NULL, 1);
}
