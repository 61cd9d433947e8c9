#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {

// Reads what a BitWriter wrote. Throws Error, "WHAT ends early", if there are fewer bits than are taken.
class BitReader {
 public:
  BitReader(std::string_view bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  // The next `bits` bits, 1 to 32.
  std::uint32_t take(int bits) {
    if (static_cast<std::size_t>(bits) > 8 * bytes_.size() - next_) throw Error(what_ + " ends early");
    std::uint32_t out = 0;
    for (int i = 0; i < bits; ++i, ++next_) {
      const auto byte = static_cast<unsigned char>(bytes_[next_ / 8]);
      out = (out << 1) | ((byte >> (7 - next_ % 8)) & 1u);
    }
    return out;
  }

  // The same as the two's complement of a signed number.
  std::int64_t take_signed(int bits) {
    const auto value = static_cast<std::int64_t>(take(bits));
    return value >= std::int64_t{1} << (bits - 1) ? value - (std::int64_t{1} << bits) : value;
  }

  std::string take_text(std::size_t length) {
    std::string out;
    for (std::size_t i = 0; i < length; ++i) out += static_cast<char>(take(8));
    return out;
  }

 private:
  std::string_view bytes_;
  std::string what_;
  std::size_t next_ = 0;
};

}  // namespace asperity
