#pragma once

#include <cmath>

#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/fourier1d.h"

namespace asperity {

// The series upside down, its mean with it.
inline Fourier1d negated(Fourier1d f) {
  for (double& a : f.a_m) a = -a;
  for (double& b : f.b_m) b = -b;
  f.mean_m = -f.mean_m;
  return f;
}

inline double highest_height_m(const Fourier1d& f) { return -lowest_height_m(negated(f)); }

// Root mean square of the series about its mean.
inline double rms_height_m(const Fourier1d& f) {
  double power = 0.0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) power += 0.5 * (f.a_m[j] * f.a_m[j] + f.b_m[j] * f.b_m[j]);
  return std::sqrt(power);
}

}  // namespace asperity
