// Not tested on hardware.
#include "driver/uart.h"
#include "link.h"

enum { kBaud = 921600, kOutBytes = 4096, kInBytes = 256 };

bool link_serial_start(void) {
  const uart_config_t config = {.baud_rate = kBaud,
                                .data_bits = UART_DATA_8_BITS,
                                .parity = UART_PARITY_DISABLE,
                                .stop_bits = UART_STOP_BITS_1,
                                .flow_ctrl = UART_HW_FLOWCTRL_DISABLE,
                                .source_clk = UART_SCLK_DEFAULT};
  return uart_driver_install(UART_NUM_0, kInBytes, kOutBytes, 0, NULL, 0) == ESP_OK &&
         uart_param_config(UART_NUM_0, &config) == ESP_OK;
}

size_t link_serial_write(void* context, const uint8_t* bytes, size_t count) {
  (void)context;
  size_t room = 0;
  if (uart_get_tx_buffer_free_size(UART_NUM_0, &room) != ESP_OK) {
    return 0;
  }
  // The driver's own headers take some of the room; with too little of it, it would wait.
  room = room > 64 ? room - 64 : 0;
  const int taken = uart_write_bytes(UART_NUM_0, bytes, count < room ? count : room);
  return taken > 0 ? (size_t)taken : 0;
}

size_t link_serial_read(void* context, uint8_t* bytes, size_t capacity) {
  (void)context;
  const int count = uart_read_bytes(UART_NUM_0, bytes, capacity, 0);
  return count > 0 ? (size_t)count : 0;
}
