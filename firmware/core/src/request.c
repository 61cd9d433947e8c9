#include "asperity_firmware/request.h"

#include "asperity_firmware/crc32.h"
#include "asperity_firmware/frame.h"

enum { kDecoded = 6, kCoded = 7 };

// A request is shorter than a full COBS block: each block but the last stands for a zero.
static bool decode(const uint8_t* block, uint8_t* out) {
  uint8_t left = 0;
  for (uint8_t i = 0; i < kCoded; ++i) {
    if (left == 0) {
      left = block[i];
      if (i > 0) {
        out[i - 1] = 0;
      }
    } else {
      out[i - 1] = block[i];
    }
    --left;
  }
  return left == 0;
}

static bool is_request(const uint8_t* block) {
  uint8_t decoded[kDecoded];
  if (!decode(block, decoded) || decoded[0] != ASP_PROTOCOL_VERSION || decoded[1] != ASP_TYPE_ASK_DESCRIPTION) {
    return false;
  }
  const uint32_t crc = asp_crc32_result(asp_crc32_put(asp_crc32_put(ASP_CRC32_START, decoded[0]), decoded[1]));
  for (unsigned i = 0; i < 4; ++i) {
    if (decoded[2 + i] != ((crc >> (8 * i)) & 0xFFu)) {
      return false;
    }
  }
  return true;
}

bool asp_request_put(asp_request_reader* reader, uint8_t byte) {
  if (byte != 0) {
    if (reader->used < sizeof reader->block) {
      reader->block[reader->used] = byte;
      ++reader->used;
    }
    return false;
  }
  const bool asked = reader->used == kCoded && is_request(reader->block);
  reader->used = 0;
  return asked;
}
