#pragma once

#include <array>
#include <cstdint>

#include "asperity/plot/drawing.h"

namespace asperity {

// viridis by S. van der Walt and N. Smith (mpl-colormaps, CC0), 256 colours: equal steps of the value are equal steps
// of perceived lightness, also in grey and for the colour-blind. `share` 0 is the darkest; it is clamped to [0, 1].
Colour viridis(double share);

// Colours of lines that the colour-blind tell apart: M. Okabe and K. Ito, "Color Universal Design" (2008), without the
// yellow, which is too light for a line on white. From the eighth on they begin again.
Colour line_colour(std::size_t index);

}  // namespace asperity
