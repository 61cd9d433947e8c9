#ifndef ASPERITY_FIRMWARE_ADS1220_H
#define ASPERITY_FIRMWARE_ADS1220_H

#include <stdbool.h>
#include <stdint.h>

#include "asperity_firmware/board.h"
#include "asperity_firmware/spi.h"

#ifdef __cplusplus
extern "C" {
#endif

// Texas Instruments ADS1220 (datasheet SBAS501): a load cell's bridge between AIN0 and AIN1, gain 128, the analogue
// supply, which feeds the bridge, as reference, so that its drift cancels. Continuous conversions in turbo mode. SPI
// mode 1, up to 6 MHz. A count is supply / (128 · 2²³): 3.07 nV at 3.3 V.
typedef enum { ASP_ADS1220_350_SPS, ASP_ADS1220_660_SPS, ASP_ADS1220_1200_SPS, ASP_ADS1220_2000_SPS } asp_ads1220_rate;

typedef enum {
  ASP_ADS1220_OK,
  ASP_ADS1220_BUS_FAILED,
  ASP_ADS1220_NOT_AS_WRITTEN  // a register reads back otherwise: not there, or wired wrongly
} asp_ads1220_status;

typedef struct {
  const asp_spi* spi;
  asp_edge edge;  // DRDY's interrupt, at its falling edge, calls asp_edge_fire(&device.edge, now)
  uint32_t period_us;
  uint32_t bus_failures;
  uint32_t skipped;  // conversions that the loop came too late for, or of which the time is not known
} asp_ads1220;

// Samples a second, nominal.
uint32_t asp_ads1220_rate_sps(asp_ads1220_rate rate);

// Resets and configures the converter, reads its registers back and starts it. Takes some 0.2 ms.
asp_ads1220_status asp_ads1220_start(asp_ads1220* device, const asp_spi* spi, asp_ads1220_rate rate);

// For asp_board.read_force: the last conversion that DRDY has announced, if any. Its filter is as long as one
// conversion, so its middle was half a period before the edge.
bool asp_ads1220_read(asp_ads1220* device, asp_force_sample* sample);

// Three bytes, the highest first, two's complement.
int32_t asp_ads1220_counts(const uint8_t* bytes);

#ifdef __cplusplus
}
#endif

#endif
