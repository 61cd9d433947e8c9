#include "utf8_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

// The first byte above 0x7F at or after `from`; eight at a time, since nearly all text is ASCII.
std::size_t next_non_ascii(std::string_view text, std::size_t from) {
  constexpr std::uint64_t kHighBits = 0x8080808080808080u;
  std::uint64_t word = 0;
  while (from + sizeof word <= text.size()) {
    std::memcpy(&word, text.data() + from, sizeof word);
    if ((word & kHighBits) != 0) break;
    from += sizeof word;
  }
  while (from < text.size() && static_cast<unsigned char>(text[from]) < 0x80) ++from;
  return from;
}

}  // namespace

void require_utf8(std::string_view text, const std::string& name) {
  std::size_t at = 0;
  while ((at = next_non_ascii(text, at)) < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!is_utf8(text.substr(at, end - at))) {
      const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
      throw Error(fmt::format("{}:{}: not UTF-8 text: {}", name, line, printable(text.substr(at, end - at))));
    }
    at = end;
  }
}

}  // namespace asperity
