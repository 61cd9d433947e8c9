#pragma once

#include <string>

#include "asperity/base/error.h"

namespace asperity {

// What find_field() of config.h throws for a path that no field has. The message names the nearest known path, if one
// is like it; else the program adds where its user finds all of them.
class UnknownSetting : public Error {
 public:
  UnknownSetting(const std::string& message, bool names_nearest) : Error(message), names_nearest_(names_nearest) {}
  bool names_nearest() const { return names_nearest_; }

 private:
  bool names_nearest_;
};

}  // namespace asperity
