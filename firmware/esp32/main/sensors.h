#pragma once

#include <stdbool.h>

#include "asperity_firmware/board.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"

// Sets up the SPI bus and starts both sensors; interrupts wake `task`, on whose core this must be called. False if
// there is no bus. An inertial sensor that does not start is tried again and reported; without the converter there is
// no force.
bool sensors_start(TaskHandle_t task);
bool sensors_have_force(void);

// For asp_board.
uint64_t sensors_clock_us(void* context);
size_t sensors_read_imu(void* context, asp_imu_row* rows, size_t capacity);
bool sensors_read_force(void* context, asp_force_sample* sample);
void sensors_read_faults(void* context, asp_faults* faults);
