#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Appends `text` as JSON writes it, in quotes. What is not UTF-8 becomes U+FFFD with `repair`, otherwise throws Error.
void append_json_text(std::string& out, std::string_view text, bool repair);

}  // namespace asperity
