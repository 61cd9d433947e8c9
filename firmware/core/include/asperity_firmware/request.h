#ifndef ASPERITY_FIRMWARE_REQUEST_H
#define ASPERITY_FIRMWARE_REQUEST_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// What the host asks for, taken from its bytes one by one. Any bytes are survived: a block that is too long for
// a request is passed over to its end.
typedef struct {
  uint8_t block[8];  // COBS-coded: two bytes of payload, four of CRC, one of code, and one to see a longer one
  uint8_t used;
} asp_request_reader;

// Takes one byte; true if it ended a sound request for the description.
bool asp_request_put(asp_request_reader* reader, uint8_t byte);

#ifdef __cplusplus
}
#endif

#endif
