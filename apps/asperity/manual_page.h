#pragma once

#include <string>

#include "parser.h"

namespace asperity::app {

// The manual page (roff, man section 1) of the program and all its commands.
std::string manual_page(const Parser& root);

}  // namespace asperity::app
