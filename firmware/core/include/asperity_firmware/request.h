#ifndef ASPERITY_FIRMWARE_REQUEST_H
#define ASPERITY_FIRMWARE_REQUEST_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Finds the host's request for the description in its bytes, taken one by one. Any bytes are survived. Start with
// zeros.
typedef struct {
  uint8_t matched;  // bytes of the request since the last zero byte
  bool other;       // the block under way is something else
} asp_request_reader;

// True if `byte` ended a sound request.
bool asp_request_put(asp_request_reader* reader, uint8_t byte);

#ifdef __cplusplus
}
#endif

#endif
