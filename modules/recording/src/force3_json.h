#pragma once

#include <optional>

#include "asperity/json/json.h"
#include "asperity/recording/calibration.h"

namespace asperity {

inline constexpr const char* kForce3 = "force3";

// {"B":[[3×3]],"C":[3],"residual_newton":[3]}.
Json force3_json(const Force3Calibration& force3);

// True if `value` is of exactly that form, finite, with a B that can be inverted; `out` is set then.
bool take_force3(const Json& value, std::optional<Force3Calibration>& out);

}  // namespace asperity
