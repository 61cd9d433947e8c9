#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"

namespace asperity {

// Texts come from strangers: these bounds hold while a text is read, before memory is taken for what it says.
struct JsonLimits {
  std::size_t bytes = std::size_t{64} << 20U;
  std::size_t depth = 32;           // objects and lists within each other
  std::size_t values = 10'000'000;  // in all, lists and objects among them
  std::size_t keys = 1'000'000;     // of one object
};

// What reading took, counted as it went: it grows with the size of the text and no faster.
struct JsonWork {
  std::uint64_t bytes = 0;        // looked at, each time that one is
  std::uint64_t values = 0;       // built
  std::uint64_t comparisons = 0;  // of keys, in the search for repeated ones
};

// The value that `text` is. Throws Error naming `name`, line, column and path for what is not JSON (RFC 8259) or not
// UTF-8, for a key that an object has twice, a number beyond doubles, and what is beyond the limits; Cancelled if the
// observer says so. The time is linear in the size (of the order of n log n for the keys of one object), whatever the
// text is. Each value knows where it began: Json::place().
Json parse_json(std::string_view text, const std::string& name = "JSON", const JsonLimits& limits = {},
                const Observer& observer = {}, JsonWork* work = nullptr);

// The same; null for what parse_json refuses.
Json parse_json_or_null(std::string_view text, const JsonLimits& limits = {});

}  // namespace asperity
