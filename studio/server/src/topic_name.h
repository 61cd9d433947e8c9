#pragma once

#include <algorithm>
#include <string_view>

namespace asperity::studio {

// The names of calls and topics: 1 to 64 of a-z, 0-9, _ and dots.
inline bool is_topic_name(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  });
}

}  // namespace asperity::studio
