#include "terminal_text.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "asperity/base/text.h"

namespace asperity::app {

namespace {

// Calls `take` with each character of `text`, as many bytes as its first byte announces.
template <class Take>
void each_character(std::string_view text, const Take& take) {
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    take(text.substr(0, length));
    text.remove_prefix(std::min(length, text.size()));
  }
}

bool is_plain(std::string_view character) {
  const char c = character.front();
  return (c >= 0x20 && c < 0x7F) || c == '\n' || c == '\t';
}

// The code of a character of two bytes or three, which all that change a terminal are.
std::uint32_t code_of(std::string_view character) {
  std::uint32_t code = static_cast<unsigned char>(character.front());
  if (character.size() > 1) code &= character.size() == 2 ? 0x1Fu : 0x0Fu;
  for (const char byte : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(byte) & 0x3Fu);
  return code;
}

}  // namespace

std::string terminal_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  each_character(text, [&](std::string_view c) {
    if (is_plain(c)) {
      out += c;
    } else {
      out += printable(c);
    }
  });
  return out;
}

std::string terminal_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  each_character(json, [&](std::string_view c) {
    if (!is_utf8(c)) {
      out += "\uFFFD";
    } else if (!is_plain(c) && printable(c) != c) {
      out += fmt::format("\\u{:04x}", code_of(c));
    } else {
      out += c;
    }
  });
  return out;
}

}  // namespace asperity::app
