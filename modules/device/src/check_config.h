#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "asperity/base/config.h"
#include "asperity/base/error.h"

namespace asperity {

// Throws Error naming the first field of `config` that is outside its range or not finite.
template <class Config>
void check_config(std::string_view name, Config config) {
  for (const ConfigField& field : list_fields(name, config)) field.set(field.get());
}

}  // namespace asperity
