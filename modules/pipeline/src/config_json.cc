#include "asperity/pipeline/config_json.h"

#include "asperity/base/config_tree.h"
#include "asperity/json/parse_json.h"
#include "json.h"

namespace asperity {

std::string config_json(const std::vector<ConfigField>& fields) { return config_tree<Json>(fields).dump(2); }

}  // namespace asperity
