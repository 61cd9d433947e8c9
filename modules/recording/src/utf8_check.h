#pragma once

#include <string>
#include <string_view>

namespace asperity {

// Throws Error naming the file and the line that is not UTF-8.
void require_utf8(std::string_view text, const std::string& name);

}  // namespace asperity
