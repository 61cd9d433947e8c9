#pragma once

#include "asperity/base/config.h"

namespace asperity {

// What a program or a person may set of a material that is to be rendered. Files may hold more (docs/texture.md,
// docs/scene.md): they were measured, and a device's caps lower them.
inline constexpr Range kStiffnessLimits_N_per_m{1.0, 1e6};
inline constexpr Range kFrictionLimits{0.0, 10.0};
inline constexpr Range kStaticFrictionRatioLimits{1.0, 10.0};

}  // namespace asperity
