#pragma once

#include <string>

namespace asperity {

struct DecodedText {
  std::string text;  // UTF-8 without a byte order mark
  bool was_latin1 = false;
};

// UTF-16 by its byte order mark, UTF-8, or what is neither as Latin-1. Throws Error naming the file for zero bytes
// (binary, or UTF-16 without a mark) and for broken UTF-16.
DecodedText decode_text(std::string bytes, const std::string& name);

}  // namespace asperity
