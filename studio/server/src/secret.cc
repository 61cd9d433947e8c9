#include "secret.h"

#include <sys/random.h>
#include <array>
#include <cstdint>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::studio {

std::string random_secret() {
  std::array<std::uint8_t, 16> bytes{};
  // Up to 256 bytes come whole or not at all.
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("the system provides no random numbers");
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const std::uint8_t byte : bytes) {
    out += kDigits[byte >> 4U];
    out += kDigits[byte & 15U];
  }
  return out;
}

bool same_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  volatile unsigned difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    difference = difference | (static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(secret[i]));
  }
  return difference == 0;
}

std::optional<std::string_view> cookie_value(std::string_view header, std::string_view name) {
  std::optional<std::string_view> found;
  while (!header.empty()) {
    const std::size_t end = header.find(';');
    const std::string_view pair = trim(header.substr(0, end));
    header = end == std::string_view::npos ? std::string_view() : header.substr(end + 1);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || trim(pair.substr(0, equals)) != name) continue;
    if (found) return std::nullopt;
    found = trim(pair.substr(equals + 1));
  }
  return found;
}

}  // namespace asperity::studio
