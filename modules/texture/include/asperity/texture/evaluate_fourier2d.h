#pragma once

#include "asperity/texture/fourier2d.h"
#include "asperity/texture/height_and_gradient.h"

namespace asperity {

// h and its gradient at (x_m, y_m): two series of N steps, or sixteen spline coefficients. C^∞ or C².
// Does not allocate. Realtime-safe: yes, thread-safe: yes. nan for a position that is not finite.
HeightAndGradient evaluate_height(const Fourier2d& texture, double x_m, double y_m) noexcept;

double lowest_height_m(const Fourier2d& texture);

}  // namespace asperity
