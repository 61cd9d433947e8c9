#include "asperity/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace asperity {

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

namespace {

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  text = trim(text);
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parse_double(std::string_view text) { return parse_number<double>(text); }
std::optional<std::int64_t> parse_int64(std::string_view text) { return parse_number<std::int64_t>(text); }

void append_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "nan";
    return;
  }
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  out.append(buffer, end);
}

void append_number(std::string& out, std::int64_t value) {
  char buffer[24];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  out.append(buffer, end);
}

void append_decimals(std::string& out, double value) {
  constexpr double kScale = 1e12, kLargest = 1000.0;  // their product is below 2^53
  constexpr std::size_t kDecimals = 12;
  if (!(std::abs(value) < kLargest)) return append_number(out, value);
  auto left = static_cast<std::uint64_t>(std::llround(std::abs(value) * kScale));
  char buffer[kDecimals + 5];
  char* const end = buffer + sizeof buffer;
  char* at = end;
  const auto digit = [&] {
    *--at = static_cast<char>('0' + left % 10);
    left /= 10;
  };
  char* last = end;  // behind the last that is not 0
  if (left % 1'000'000 == 0) {
    left /= 1'000'000;
    for (std::size_t i = 0; i < kDecimals / 2; ++i) digit();
  } else {
    for (std::size_t i = 0; i < kDecimals; ++i) digit();
  }
  while (last > at && last[-1] == '0') --last;
  if (last > at) *--at = '.';
  do digit();
  while (left > 0);
  if (value < 0.0 && (last - at > 1 || *at != '0')) *--at = '-';
  out.append(at, last);
}

void append_exact(std::string& out, double value) {
  constexpr double kWholeNumbers = 9007199254740992.0;  // 2^53: all whole numbers below are exact
  if (std::abs(value) < kWholeNumbers && value == std::trunc(value) && !(value == 0.0 && std::signbit(value))) {
    append_number(out, static_cast<std::int64_t>(value));
  } else {
    append_number(out, value);
  }
}

std::string number_text(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

namespace {

// The length of the well-formed UTF-8 sequence at the start of `text`, or 0; `code` becomes its character.
std::size_t utf8_sequence(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  code = lead;
  if (lead < 0x80) return 1;
  std::size_t length = 0;
  std::uint32_t smallest = 0;
  if ((lead & 0xE0) == 0xC0) {
    length = 2, code = lead & 0x1Fu, smallest = 0x80;
  } else if ((lead & 0xF0) == 0xE0) {
    length = 3, code = lead & 0x0Fu, smallest = 0x800;
  } else if ((lead & 0xF8) == 0xF0) {
    length = 4, code = lead & 0x07u, smallest = 0x10000;
  } else {
    return 0;
  }
  if (text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < smallest || code > 0x10FFFF || surrogate ? 0 : length;
}

// What changes a terminal or the order of what is read on it: C0 and C1 controls, bidirectional marks, embeddings and
// isolates (Unicode 15, UAX 9), line and paragraph separators, the byte order mark.
bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x61C || code == 0x200E || code == 0x200F ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t length = utf8_sequence(text, code);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string printable(std::string_view text, std::size_t limit) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  while (!text.empty()) {
    if (out.size() >= limit) return out + "…";
    std::uint32_t code = 0;
    const std::size_t length = utf8_sequence(text, code);
    if (length == 0 || is_control(code)) {
      for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        out += "\\x";
        out += kHex[byte >> 4];
        out += kHex[byte & 15];
      }
      text.remove_prefix(std::max<std::size_t>(length, 1));
    } else {
      out += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return out;
}

}  // namespace asperity
