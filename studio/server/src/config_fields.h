#pragma once

#include <vector>

#include "asperity/base/config.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// Settings as the app's form shows them: [{"path","type","value","default","description","low","high","choices"}].
// `fields` and `defaults` list the same config, as it is and as it begins.
Json fields_json(const std::vector<ConfigField>& fields, const std::vector<ConfigField>& defaults);

}  // namespace asperity::studio
