#pragma once

#include <span>

namespace asperity {

// Powers of a window's amplitude with the force that acted: E[power] = c² exp(-2 g (F^p - 1) / p) + noise.
struct ForcePowers {
  std::span<const double> force_N;
  std::span<const double> power;
  std::span<const double> noise;  // what of it does not come from the texture, known
};

struct ForceLaw {
  double softness = 0.0;         // g: how fast the amplitude's logarithm falls with that of the force, at 1 N
  double softness_stderr = 0.0;  // from the scatter of the powers
  double deviance = 0.0;         // Σ ln E + power / E
  double dispersion = 0.0;       // variance of power over its expectation
};

// Maximum quasi-likelihood of a gamma distribution (McCullagh and Nelder, Generalized Linear Models, 1989, §8.3 and
// 9.2), for one p > 0: the powers of noise-like textures are such, and a constant relative scatter holds for others.
// The variance of the estimate has the dispersion that the data show. Windows are to be nearly independent. Needs at
// least 3 windows with different positive forces.
ForceLaw fit_force_law(const ForcePowers& data, double force_power);

}  // namespace asperity
