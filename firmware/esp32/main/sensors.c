// Not tested on hardware.
#include "sensors.h"

#include <string.h>

#include "asperity_firmware/sensors.h"
#include "driver/gpio.h"
#include "driver/spi_master.h"
#include "esp_attr.h"
#include "esp_rom_sys.h"
#include "esp_timer.h"
#include "pins.h"

enum { kLongestTransfer = 1 + ASP_ICM42688_WATERMARK * ASP_PACKET_BYTES };

typedef struct {
  spi_device_handle_t handle;
} spi_target;

static TaskHandle_t s_task;
static spi_target s_imu_target;
static spi_target s_adc_target;
static asp_sensors s_sensors;

// The bus's memory access wants whole words of its own memory.
static DMA_ATTR uint8_t s_out[(kLongestTransfer + 3) / 4 * 4];
static DMA_ATTR uint8_t s_in[(kLongestTransfer + 3) / 4 * 4];

static bool transfer(void* context, const uint8_t* out, uint8_t* in, size_t count) {
  if (count > kLongestTransfer) {
    return false;
  }
  memcpy(s_out, out, count);
  spi_transaction_t transaction = {.length = 8 * count, .tx_buffer = s_out, .rx_buffer = s_in};
  if (spi_device_polling_transmit(((spi_target*)context)->handle, &transaction) != ESP_OK) {
    return false;
  }
  memcpy(in, s_in, count);
  return true;
}

static void wait_us(void* context, uint32_t us) {
  (void)context;
  if (us >= 10000) {
    vTaskDelay(pdMS_TO_TICKS(us / 1000 + 1));
  } else {
    esp_rom_delay_us(us);
  }
}

static const asp_spi s_imu_spi = {&s_imu_target, transfer, wait_us};
static const asp_spi s_adc_spi = {&s_adc_target, transfer, wait_us};

static void IRAM_ATTR on_edge(void* edge) {
  asp_edge_fire(edge, (uint64_t)esp_timer_get_time());
  BaseType_t woken = pdFALSE;
  vTaskNotifyGiveFromISR(s_task, &woken);
  portYIELD_FROM_ISR(woken);
}

static bool add_target(spi_target* target, int select_pin, int mode, int clock_Hz) {
  const spi_device_interface_config_t config = {
      .mode = mode, .clock_speed_hz = clock_Hz, .spics_io_num = select_pin, .queue_size = 1};
  return spi_bus_add_device(SPI3_HOST, &config, &target->handle) == ESP_OK;
}

static bool add_interrupt(int pin, gpio_int_type_t type, asp_edge* edge) {
  const gpio_config_t config = {.pin_bit_mask = 1ULL << pin, .mode = GPIO_MODE_INPUT, .intr_type = type};
  return gpio_config(&config) == ESP_OK && gpio_isr_handler_add(pin, on_edge, edge) == ESP_OK;
}

bool sensors_start(TaskHandle_t task) {
  s_task = task;
  const spi_bus_config_t bus = {.sclk_io_num = kPinClock,
                                .miso_io_num = kPinMiso,
                                .mosi_io_num = kPinMosi,
                                .quadwp_io_num = -1,
                                .quadhd_io_num = -1,
                                .max_transfer_sz = sizeof s_out};
  // What a failed attempt has set up stays for the next.
  static bool s_bus_ready;
  if (!s_bus_ready) {
    s_bus_ready = spi_bus_initialize(SPI3_HOST, &bus, SPI_DMA_CH_AUTO) == ESP_OK &&
                  add_target(&s_imu_target, kPinImuSelect, 0, 8000000) &&
                  add_target(&s_adc_target, kPinAdcSelect, 1, 4000000) && gpio_install_isr_service(0) == ESP_OK &&
                  add_interrupt(kPinImuInterrupt, GPIO_INTR_POSEDGE, &s_sensors.imu.edge) &&
                  add_interrupt(kPinAdcReady, GPIO_INTR_NEGEDGE, &s_sensors.force.edge);
  }
  if (!s_bus_ready) {
    return false;
  }
  // A probe may have no load cell: what does not answer at first is not tried again.
  const bool have_force = asp_ads1220_start(&s_sensors.force, &s_adc_spi, ASP_ADS1220_660_SPS) == ASP_ADS1220_OK;
  asp_sensors_start(&s_sensors, &s_imu_spi, have_force ? &s_adc_spi : NULL, ASP_ADS1220_660_SPS,
                    (uint64_t)esp_timer_get_time());
  return true;
}

bool sensors_have_force(void) { return s_sensors.force_spi != NULL; }

uint64_t sensors_clock_us(void* context) {
  (void)context;
  return (uint64_t)esp_timer_get_time();
}

size_t sensors_read_imu(void* context, asp_imu_row* rows, size_t capacity) {
  (void)context;
  return asp_sensors_read_imu(&s_sensors, (uint64_t)esp_timer_get_time(), rows, capacity);
}

bool sensors_read_force(void* context, asp_force_sample* sample) {
  (void)context;
  return asp_sensors_read_force(&s_sensors, (uint64_t)esp_timer_get_time(), sample);
}

void sensors_read_faults(void* context, asp_faults* faults) {
  (void)context;
  asp_sensors_read_faults(&s_sensors, faults);
}
