#ifndef ASPERITY_FIRMWARE_FRAME_H
#define ASPERITY_FIRMWARE_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Frames of docs/probe-protocol.md: COBS(payload, CRC-32(payload)), 00h. The payload is coded while it is
// written: there is no second buffer.

#define ASP_PROTOCOL_VERSION 1u
#define ASP_TYPE_SAMPLES 0x01u
#define ASP_TYPE_DESCRIPTION 0x02u
#define ASP_TYPE_FAULTS 0x03u
#define ASP_TYPE_ASK_DESCRIPTION 0x81u

// Bytes on the line of a frame with this payload, at most: the CRC, one code byte for each 254 bytes begun (one
// at least), the zero.
#define ASP_FRAME_BYTES(payload) ((payload) + 4u + ((payload) + 4u + 253u) / 254u + 1u)

typedef struct {
  uint8_t* out;
  size_t capacity;
  size_t used;
  size_t code_at;   // where the open COBS block's length goes
  bool block_open;  // false after a full block: the next one is opened by the byte that needs it
  bool overflow;
  uint32_t crc;
} asp_frame_writer;

// Starts a frame in `out`, which it keeps.
void asp_frame_begin(asp_frame_writer* writer, uint8_t* out, size_t capacity);

// Append to the payload, little-endian.
void asp_frame_put_u8(asp_frame_writer* writer, uint8_t value);
void asp_frame_put_u16(asp_frame_writer* writer, uint16_t value);
void asp_frame_put_u32(asp_frame_writer* writer, uint32_t value);
void asp_frame_put_u64(asp_frame_writer* writer, uint64_t value);
void asp_frame_put_bytes(asp_frame_writer* writer, const uint8_t* bytes, size_t count);

// Ends the frame. Returns its bytes on the line, the final zero included; 0 if it did not fit.
size_t asp_frame_end(asp_frame_writer* writer);

#ifdef __cplusplus
}
#endif

#endif
