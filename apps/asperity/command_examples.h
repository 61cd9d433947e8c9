#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity::app {

// Command lines that a command is used by, as they are typed; `command` as Parser::full_name() gives it.
std::vector<std::string> command_examples(std::string_view command);

}  // namespace asperity::app
