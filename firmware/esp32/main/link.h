#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// For asp_board; none waits.
bool link_serial_start(void);
size_t link_serial_write(void* context, const uint8_t* bytes, size_t count);
size_t link_serial_read(void* context, uint8_t* bytes, size_t capacity);

bool link_udp_start(void);
size_t link_udp_write(void* context, const uint8_t* bytes, size_t count);
size_t link_udp_read(void* context, uint8_t* bytes, size_t capacity);
