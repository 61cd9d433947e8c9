#ifndef ASPERITY_FIRMWARE_SENSORS_H
#define ASPERITY_FIRMWARE_SENSORS_H

#include "asperity_firmware/ads1220.h"
#include "asperity_firmware/faults.h"
#include "asperity_firmware/icm42688.h"

#ifdef __cplusplus
extern "C" {
#endif

// Both sensors behind asp_board: starts them, and starts one again that gives nothing for a time (a stuck line, a lost
// supply: an SPI bus cannot report these), then twice a second until it gives something. Counts their faults.
#define ASP_IMU_SILENCE_US 200000u
#define ASP_FORCE_SILENCE_US 200000u
#define ASP_RETRY_US 500000u

typedef struct {
  asp_icm42688 imu;
  asp_ads1220 force;  // INT1 and DRDY call asp_edge_fire() with the edges of both
  const asp_spi* imu_spi;
  const asp_spi* force_spi;  // NULL: there is no force sensor
  asp_ads1220_rate force_rate;
  uint64_t imu_due_us;  // by then a row comes, or the sensor is started again
  uint64_t force_due_us;
  asp_faults faults;  // those of the drivers before they were started again
} asp_sensors;

// Starts both; those that fail are tried again later. Takes some 60 ms.
void asp_sensors_start(asp_sensors* sensors, const asp_spi* imu_spi, const asp_spi* force_spi,
                       asp_ads1220_rate force_rate, uint64_t now_us);

// For asp_board.read_imu. Where a start is due it takes 60 ms.
size_t asp_sensors_read_imu(asp_sensors* sensors, uint64_t now_us, asp_imu_row* rows, size_t capacity);

// For asp_board.read_force.
bool asp_sensors_read_force(asp_sensors* sensors, uint64_t now_us, asp_force_sample* sample);

// For asp_board.read_faults.
void asp_sensors_read_faults(const asp_sensors* sensors, asp_faults* faults);

#ifdef __cplusplus
}
#endif

#endif
