#pragma once

#include <stdbool.h>

#include "asperity_firmware/board.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"

// Starts both sensors on one SPI bus; interrupts wake `task`, on whose core this must be called. False without the
// inertial sensor; without the converter there is no force.
bool sensors_start(TaskHandle_t task);
bool sensors_have_force(void);

// For asp_board.
uint64_t sensors_clock_us(void* context);
size_t sensors_read_imu(void* context, asp_imu_row* rows, size_t capacity);
bool sensors_read_force(void* context, asp_force_sample* sample);
