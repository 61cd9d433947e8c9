#ifndef ASPERITY_FIRMWARE_CRC32_H
#define ASPERITY_FIRMWARE_CRC32_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// CRC-32/ISO-HDLC (docs/probe-protocol.md). Start with ASP_CRC32_START, put in the bytes one by one, take
// asp_crc32_result() at the end: "123456789" gives CBF43926h.
#define ASP_CRC32_START 0xFFFFFFFFu

extern const uint32_t asp_crc32_nibbles[16];

// Half a byte at a time: 64 bytes of table instead of 1024. In the header, as it is done for each byte on the line.
static inline uint32_t asp_crc32_put(uint32_t state, uint8_t byte) {
  state ^= byte;
  state = (state >> 4) ^ asp_crc32_nibbles[state & 15u];
  return (state >> 4) ^ asp_crc32_nibbles[state & 15u];
}

static inline uint32_t asp_crc32_result(uint32_t state) { return state ^ 0xFFFFFFFFu; }

#ifdef __cplusplus
}
#endif

#endif
