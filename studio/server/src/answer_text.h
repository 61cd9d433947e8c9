#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "asperity/studio/block.h"

namespace asperity::studio {

// The text frames that a server sends (docs/studio-protocol.md). What is not UTF-8 in them is replaced.
std::string answer_text(std::uint64_t id, const Json& result);
std::string refusal_text(std::uint64_t id, std::string_view message, std::string_view hint);
std::string event_text(std::string_view event, const Json& data);

}  // namespace asperity::studio
