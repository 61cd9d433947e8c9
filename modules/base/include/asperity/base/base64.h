#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

// What it spells; nothing if it is not of that alphabet or its length is no multiple of four.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace asperity
