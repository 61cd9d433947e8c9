#ifndef ASPERITY_FIRMWARE_ADS1220_MODEL_H
#define ASPERITY_FIRMWARE_ADS1220_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The ADS1220's commands and registers as its datasheet (SBAS501) has them, for tests of the driver.
typedef struct {
  // Faults.
  bool present;    // false: its data line is high for ever
  bool bus_works;  // false: transfers are refused

  // The world. `during_read` is called while a value is being read; NULL: nothing happens then.
  void* context;
  void (*during_read)(void* context);

  // State.
  uint8_t registers[4];
  bool converting;
  uint32_t data;  // 24 bits
} asp_ads1220_model;

// Switched on, without a fault.
void asp_ads1220_model_init(asp_ads1220_model* model);

// A conversion has ended with `counts`. Returns whether DRDY falls: not, unless it was told to convert.
bool asp_ads1220_model_finish(asp_ads1220_model* model, int32_t counts);

// For asp_spi.transfer.
bool asp_ads1220_model_transfer(asp_ads1220_model* model, const uint8_t* out, uint8_t* in, size_t count);

#ifdef __cplusplus
}
#endif

#endif
