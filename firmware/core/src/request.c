#include "asperity_firmware/request.h"

// Nothing follows its version and type, so its frame is always these bytes: the COBS group of all six, version, type,
// CRC-32. No other block decodes to them.
static const uint8_t kRequest[] = {0x07, 0x01, 0x81, 0x08, 0x90, 0x7D, 0xC2};

bool asp_request_put(asp_request_reader* reader, uint8_t byte) {
  if (byte == 0) {
    const bool asked = !reader->other && reader->matched == sizeof kRequest;
    reader->matched = 0;
    reader->other = false;
    return asked;
  }
  if (reader->matched < sizeof kRequest && kRequest[reader->matched] == byte) {
    ++reader->matched;
  } else {
    reader->other = true;
  }
  return false;
}
