#pragma once

#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// Settings as the app's form shows them: [{"path","type","value","default","description","low","high","choices"}].
// `fields` and `defaults` list the same config, as it is and as it begins.
Json fields_json(const std::vector<ConfigField>& fields, const std::vector<ConfigField>& defaults);

// Gives the member `key` of a section, an object of settings by their paths, the settings' present names where it has
// former ones (ConfigField::former). Leaves any other value unchanged.
void use_present_names(Json& section, std::string_view key, const std::vector<ConfigField>& fields);

}  // namespace asperity::studio
