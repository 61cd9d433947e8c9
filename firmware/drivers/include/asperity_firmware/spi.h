#ifndef ASPERITY_FIRMWARE_SPI_H
#define ASPERITY_FIRMWARE_SPI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A device on an SPI bus.
typedef struct {
  void* context;
  // Sends `count` bytes while it receives as many, its chip-select low throughout. `in` may be `out`. False if the bus
  // failed.
  bool (*transfer)(void* context, const uint8_t* out, uint8_t* in, size_t count);
  // Waits at least so long. Called while a device is started, never later.
  void (*wait_us)(void* context, uint32_t us);
} asp_spi;

// The time of an interrupt, handed from the interrupt to the loop on the same core: the first edge since the loop armed
// it, the latest one, and how many came after the first.
typedef struct {
  volatile uint64_t time_us;  // valid while `state` is ASP_EDGE_SEEN
  volatile uint64_t latest_us;
  volatile uint32_t state;
  volatile uint32_t more;
} asp_edge;

enum { ASP_EDGE_OFF = 0, ASP_EDGE_ARMED = 1, ASP_EDGE_SEEN = 2 };

// To be called in the interrupt.
static inline void asp_edge_fire(asp_edge* edge, uint64_t now_us) {
  if (edge->state == ASP_EDGE_ARMED) {
    edge->time_us = now_us;
    edge->latest_us = now_us;
    edge->more = 0;
    edge->state = ASP_EDGE_SEEN;
  } else if (edge->state == ASP_EDGE_SEEN) {
    edge->latest_us = now_us;
    edge->more = edge->more + 1u;
  }
}

#ifdef __cplusplus
}
#endif

#endif
