#pragma once

#include <string>

#include "parser.h"

namespace asperity::app {

// A script for "bash", "fish" or "zsh" that completes commands, options, the values of options that have a few, and
// file names.
std::string shell_completion(const std::string& shell, const Parser& root);

}  // namespace asperity::app
