#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

// The decoded bytes; nothing if a character is not of that alphabet or the length is not a multiple of four.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace asperity
