#pragma once

#include <string>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/json/json.h"
#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_profile_texture.h"

namespace asperity::app {

// One parameter as it is printed: name with the unit of files, value, standard error where it is known.
struct PrintedParameter {
  std::string key;
  double value = kNan;
  bool length = true;
  double error = kNan;
};

Json to_json(const std::vector<PrintedParameter>& parameters);
std::string to_table(const std::vector<PrintedParameter>& parameters);

// P, R and W: an object each, with values in SI units and standard errors, null where not determined.
Json to_json(const ProfileTexture& texture);
// A line a parameter: those of P, R and W beside each other.
std::string to_table(const ProfileTexture& texture);

// With standard errors where they are known.
Json to_json(const ArealTextureResult& result);
std::string to_table(const ArealTextureResult& result);

}  // namespace asperity::app
