#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"

namespace asperity::app {

// The settings that --set of a command reaches, for the scripts that complete it.
struct CommandSettings {
  std::string command;  // as it is typed: "process", "texture fit"
  std::vector<ConfigField> fields;
};

// One line of a `case` of a shell: "    PATTERN) VARIABLE=OPEN words CLOSE ;;".
struct CaseSyntax {
  std::string_view variable;  // that gets the words
  std::string_view open, close;

  std::string line(const std::string& pattern, const std::string& words) const;
};

// What a choice or a switch takes; empty for numbers and texts.
std::vector<std::string> values_of(const ConfigField& field);

// "process.method= reference= …"
std::string setting_keys(const CommandSettings& settings);

// Over "COMMAND --set": the keys.
std::string setting_key_cases(const std::vector<CommandSettings>& all, const CaseSyntax& syntax);

// Over "COMMAND KEY": the values of a key that has a few; one line for all commands in which these are the same.
std::string setting_value_cases(const std::vector<CommandSettings>& all, const CaseSyntax& syntax);

}  // namespace asperity::app
