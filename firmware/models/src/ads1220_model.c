#include "asperity_firmware/ads1220_model.h"

#include <string.h>

enum { kLongestTransfer = 5 };

void asp_ads1220_model_init(asp_ads1220_model* model) {
  memset(model, 0, sizeof *model);
  model->present = true;
  model->bus_works = true;
}

bool asp_ads1220_model_finish(asp_ads1220_model* model, int32_t counts) {
  if (!model->converting || !model->present) {
    return false;
  }
  model->data = (uint32_t)counts & 0xFFFFFFu;
  return true;
}

static void read_data(asp_ads1220_model* model, uint8_t* in, size_t count) {
  for (size_t i = 1; i < count && i < 4; ++i) {
    in[i] = (uint8_t)((model->data >> (24u - 8u * i)) & 0xFFu);
  }
  if (model->during_read != NULL) {
    model->during_read(model->context);
  }
}

bool asp_ads1220_model_transfer(asp_ads1220_model* model, const uint8_t* out, uint8_t* in, size_t count) {
  if (!model->bus_works || count == 0 || count > kLongestTransfer) {
    return false;
  }
  uint8_t sent[kLongestTransfer];  // `in` may be `out`
  memcpy(sent, out, count);
  memset(in, 0xFF, count);
  if (!model->present) {
    return true;
  }
  const uint8_t command = sent[0];
  const size_t first = (command >> 2) & 3u;
  const size_t last = first + (command & 3u);
  if ((command & 0xFEu) == 0x06u) {
    memset(model->registers, 0, sizeof model->registers);
    model->converting = false;
  } else if ((command & 0xFEu) == 0x08u) {
    model->converting = (model->registers[1] & 0x04u) != 0;
  } else if ((command & 0xF0u) == 0x10u) {
    read_data(model, in, count);
  } else if ((command & 0xF0u) == 0x40u || (command & 0xF0u) == 0x20u) {
    for (size_t i = 1; i < count && first + i - 1u <= last && first + i - 1u < 4u; ++i) {
      uint8_t* place = &model->registers[first + i - 1u];
      if ((command & 0xF0u) == 0x40u) {
        *place = sent[i];
      } else {
        in[i] = *place;
      }
    }
  }
  return true;
}
