#pragma once

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {

// The numbers of a block, listed once for reading and writing: `list(field)` calls
// field(key, value, low, high) for each. When read, one that is not there keeps its default.
struct FlatReader {
  const BlockInput& input;
  void operator()(const char* key, double& value, double low, double high) const {
    value = optional_number(input.json, input.path, key, low, high, value);
  }
};

struct FlatWriter {
  BlockText& block;
  void operator()(const char* key, const double& value, double low, double high) const {
    if (!(value >= low && value <= high)) {
      throw Error(std::string("texture: '") + key + "' is " + number_text(value) + ", not within " + number_text(low) +
                  " and " + number_text(high));
    }
    block.add(key, value);
  }
};

}  // namespace asperity
