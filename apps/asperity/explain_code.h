#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity::app {

// What docs/troubleshooting.md says of the code of a verdict, or of `exit-3`: its severity, what it means, what to do,
// and where on the page it is, in lines of at most 100 characters. Nothing where it has no such code.
std::optional<std::string> explain_code(std::string_view code);

}  // namespace asperity::app
