#pragma once

#include <string>
#include <string_view>

namespace asperity {

// `text` as HTML shows it, in an element or between the double quotes of an attribute: &, <, > and " as character
// references (HTML Living Standard, "Escaping a string"). Other bytes stay.
std::string html_text(std::string_view text);

}  // namespace asperity
