#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/error.h"

namespace asperity::app {

// Sets `fields` from a TOML file. Throws Error naming file and line for bad TOML, an unknown key or a
// value that the field refuses.
void load_config_file(const std::filesystem::path& path, const std::vector<ConfigField>& fields);

// The message of `error`; of an unknown setting without a similar one, also where all of them are listed.
std::string setting_fault(const Error& error);

// The fields as one JSON object, an object a group.
std::string fields_to_json(const std::vector<ConfigField>& fields);

}  // namespace asperity::app
