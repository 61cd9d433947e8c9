#pragma once

#include "asperity/json/parse_json.h"
#include "asperity/recording/read_limits.h"

namespace asperity {

inline JsonLimits json_limits(const ReadLimits& limits) {
  JsonLimits out;
  out.bytes = limits.json_bytes;
  out.depth = static_cast<std::size_t>(limits.json_depth);
  out.values = out.keys = static_cast<std::size_t>(limits.json_values);
  return out;
}

}  // namespace asperity
