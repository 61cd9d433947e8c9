#include "asperity/base/decode_text.h"

#include <cstdint>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

void append_utf8(std::string& out, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | code >> 6);
    add(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
    add(0x80 | (code & 0x3F));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
    add(0x80 | (code & 0x3F));
  }
}

std::string utf8_of_utf16(const std::string& bytes, bool big_endian, const std::string& name) {
  if (bytes.size() % 2 != 0) throw Error(name + ": UTF-16 text with an odd number of bytes");
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]), second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<std::uint32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string out;
  out.reserve(bytes.size() / 2);
  for (std::size_t at = 2; at < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xD800 && code < 0xE000) {
      const std::uint32_t low = code < 0xDC00 && at + 3 < bytes.size() ? unit(at + 2) : 0;
      if (low < 0xDC00 || low >= 0xE000) {
        throw Error(name + ": broken UTF-16 at byte " + std::to_string(at));
      }
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      at += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

}  // namespace

DecodedText decode_text(std::string bytes, const std::string& name) {
  DecodedText out;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    out.text = utf8_of_utf16(bytes, bytes.front() == '\xFE', name);
  } else {
    out.text = std::move(bytes);
    if (out.text.starts_with("\xEF\xBB\xBF")) out.text.erase(0, 3);
  }
  if (out.text.find('\0') != std::string::npos) {
    throw Error(name + ": has zero bytes: binary data, or UTF-16 without a byte order mark, is not read here");
  }
  if (is_utf8(out.text)) return out;
  std::string decoded;
  decoded.reserve(out.text.size() + out.text.size() / 8);
  for (const char byte : out.text) append_utf8(decoded, static_cast<unsigned char>(byte));
  return {std::move(decoded), true};
}

}  // namespace asperity
