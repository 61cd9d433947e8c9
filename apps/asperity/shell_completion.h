#pragma once

#include <string>
#include <vector>

#include "completion_settings.h"
#include "parser.h"

namespace asperity::app {

// A script for "bash", "fish" or "zsh" that completes commands, options, the values of options that have a few, the
// keys of --set and the values of those that have a few, and file names.
std::string shell_completion(const std::string& shell, const Parser& root,
                             const std::vector<CommandSettings>& settings);

}  // namespace asperity::app
