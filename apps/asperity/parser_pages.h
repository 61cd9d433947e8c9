#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace asperity::app {

// The manual page (roff, man section 1) of the program and all its commands.
std::string manual_page(const CLI::App& root);

// A bash script that completes commands, options and file names.
std::string bash_completion(const CLI::App& root);

}  // namespace asperity::app
