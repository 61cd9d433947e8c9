#pragma once

#include <initializer_list>
#include <string_view>

#include "asperity/studio/block.h"

namespace asperity::studio {

// Throws Error naming `page` for a key of `object` that is none of `known`.
void refuse_unknown(const Json& object, std::initializer_list<std::string_view> known, std::string_view page);

}  // namespace asperity::studio
