#ifndef ASPERITY_FIRMWARE_FAULTS_H
#define ASPERITY_FIRMWARE_FAULTS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// How a sensor is, by the protocol (docs/probe-protocol.md, type 03h).
typedef enum {
  ASP_SENSOR_WORKS = 0,
  ASP_SENSOR_BUS_FAILS = 1,
  ASP_SENSOR_NOT_FOUND = 2,
  ASP_SENSOR_NO_RESET = 3,
  ASP_SENSOR_NOT_AS_WRITTEN = 4,
  ASP_SENSOR_NO_SAMPLES = 5
} asp_sensor_state;

// States of both sensors, and counts since the probe was switched on, in the order of the protocol.
enum {
  ASP_FAULTS_IMU_BUS_FAILURES,
  ASP_FAULTS_IMU_OVERFLOWS,
  ASP_FAULTS_IMU_LOST_SYNC,
  ASP_FAULTS_IMU_INVALID_ROWS,
  ASP_FAULTS_IMU_RESTARTS,
  ASP_FAULTS_FORCE_BUS_FAILURES,
  ASP_FAULTS_FORCE_SKIPPED,
  ASP_FAULTS_FORCE_RESTARTS,
  ASP_FAULTS_COUNTS
};

typedef struct {
  uint8_t imu_state;  // an asp_sensor_state
  uint8_t force_state;
  uint32_t counts[ASP_FAULTS_COUNTS];
} asp_faults;

#ifdef __cplusplus
}
#endif

#endif
