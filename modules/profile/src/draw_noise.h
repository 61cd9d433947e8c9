#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {

// `count` Gaussian numbers `spacing_mm` apart with the one-sided density (m²/(cycles/mm)) that is given by straight
// lines over rising frequencies (cycles/mm), 0 outside them.
std::vector<double> draw_noise(std::span<const double> frequency, std::span<const double> density, std::size_t count,
                               double spacing_mm, Random& random);

}  // namespace asperity
