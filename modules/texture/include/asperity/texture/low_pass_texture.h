#pragma once

#include "asperity/texture/texture.h"

namespace asperity {

// The gain of the roll-off at `f`, both in one unit: 1 up to half the cut-off, 0 from the cut-off on, and
// cos²(π (f/cutoff − ½)) between. A step overshoots by 8 % of its height.
double low_pass_gain(double f, double cutoff);

// A texture without what is finer than the cut-off, of zero phase and with its mean kept (the reconstruction filter
// of Campion and Hayward 2005; thesis §2.1). Fourier series: their coefficients times the gain, those that are zero
// left out; products: both factors, so that a diagonal may hold √2 times the cut-off; isotropic surfaces: the
// amplitudes of their waves, phases kept; images and splines: rows, then columns, continued as their border says; the
// image becomes one of 16 bits with the range that its heights need. The correlation length of stochastic textures
// becomes no shorter than half a wave of the cut-off. Series in time are left as they are: their rate bounds them.
// Throws Error for a cut-off that is not positive.
Texture low_pass_texture(const Texture& texture, double cutoff_cycles_per_mm);

}  // namespace asperity
