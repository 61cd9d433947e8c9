#ifndef ASPERITY_FIRMWARE_QEMU_WORLD_H
#define ASPERITY_FIRMWARE_QEMU_WORLD_H

#include "asperity_firmware/ads1220_model.h"
#include "asperity_firmware/icm42688_model.h"
#include "asperity_firmware/sensors.h"
#include "measure.h"

// The sensors round the processor: their register models behind two SPIs, their time by the machine's alarm, and what
// goes wrong with them when. INT1, DRDY and the millisecond end world_wait().

#define WORLD_ROW_NS 252100u  // the sensor's own clock is 0.8 % slow
#define WORLD_CONVERSION_NS 1515152u

typedef enum { WORLD_CLEAN, WORLD_FAULTS, WORLD_ABSENT } world_scenario;

void world_start(asp_sensors* sensors, world_scenario scenario);

// No more rows and conversions.
void world_stop(void);

uint64_t world_us(void);
void world_wait(void);
void world_spin_us(uint32_t us);

// Of the loop, by the scenario: how long it has to stand still now, bytes for the host that are to be damaged.
uint32_t world_stall_us(void);
uint32_t world_damaged_bytes(void);

extern const asp_spi world_imu_spi;
extern const asp_spi world_force_spi;
extern asp_icm42688_model world_imu;
extern asp_ads1220_model world_force;
extern uint32_t world_conversions;
extern measured world_bus;  // time in transfers

#endif
