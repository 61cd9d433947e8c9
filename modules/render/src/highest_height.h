#pragma once

#include "asperity/texture/texture.h"

namespace asperity {

// The highest point of a height field. Throws Error for a model that is none.
double highest_height_m(const TextureModel& model);

}  // namespace asperity
