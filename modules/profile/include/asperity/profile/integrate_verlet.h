#pragma once

#include <span>
#include <vector>

namespace asperity {

// The height whose second derivative is `a_mps2`, sampled every `period_s`, from rest at zero, m:
// h[i+1] = 2h[i] − h[i−1] + a[i] Δt² (seed §5.1, erratum 2), with h[1] = a[0] Δt²/2. Computed by its steps
// d[i+1] = d[i] + a[i] Δt², h[i+1] = h[i] + d[i+1]: the same scheme, but 2h[i] − h[i−1] would lose seven
// digits over a million samples. Throws Error unless the period is positive.
std::vector<double> integrate_verlet(std::span<const double> a_mps2, double period_s);

}  // namespace asperity
