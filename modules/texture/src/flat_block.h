#pragma once

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "model_block.h"

namespace asperity {

// The numbers of a block, listed once for reading and writing: `list(field)` calls
// field(key, value, low, high) for each. When read, one that is not there keeps its default.
struct FlatReader {
  const BlockInput& input;
  void operator()(const char* key, double& value, double low, double high) const {
    input.block.read_number(key, value, {low, high});
  }
};

struct FlatWriter {
  JsonWriter& block;
  void operator()(const char* key, const double& value, double low, double high) const {
    if (!(value >= low && value <= high)) {
      throw Error(std::string("texture: '") + key + "' is " + number_text(value) + ", not within " + number_text(low) +
                  " and " + number_text(high));
    }
    block.number(key, value);
  }
};

}  // namespace asperity
