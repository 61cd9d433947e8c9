#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace asperity {

inline std::string_view fuzz_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// What must hold for every input; the fuzzer keeps the input for which it does not.
inline void must(bool holds) {
  if (!holds) std::abort();
}

}  // namespace asperity
