#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace asperity {

// Fields of any number of bits one after the other, each from its highest bit on, as binary formats of MPEG have them.
class BitWriter {
 public:
  // The lowest `bits` bits of `value`, 1 to 32 of them; a negative value as its two's complement.
  void put(std::int64_t value, int bits) {
    for (int bit = bits - 1; bit >= 0; --bit) {
      if (free_ == 0) {
        bytes_ += '\0';
        free_ = 8;
      }
      --free_;
      if (((value >> bit) & 1) != 0) bytes_.back() = static_cast<char>(bytes_.back() | (1 << free_));
    }
  }

  void put_text(std::string_view text) {
    for (const char c : text) put(static_cast<unsigned char>(c), 8);
  }

  // What was put, with zeros up to the next byte.
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  int free_ = 0;  // lowest bits of the last byte that are not used yet
};

}  // namespace asperity
