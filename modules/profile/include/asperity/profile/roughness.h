#pragma once

#include <cstddef>

namespace asperity {

// Parameters of a roughness profile, heights counted from its mean line. A parameter that the profile
// does not define (RSm without a whole profile element, Rsk of a flat profile) is nan.
struct RoughnessResult {
  double Ra_m = 0.0;     // mean absolute height
  double Rq_m = 0.0;     // root mean square height
  double Rz_m = 0.0;     // mean over the sections of each one's highest minus its lowest point
  double Rt_m = 0.0;     // highest minus lowest point of the whole profile
  double Rsk = 0.0;      // skewness, mean(z³) / Rq³
  double Rku = 0.0;      // kurtosis, mean(z⁴) / Rq⁴; 3 for a normal distribution
  double RSm_m = 0.0;    // mean width of the profile elements (a hill and a pit)
  double R5p_m = 0.0;    // mean of the five highest significant peaks
  double R5v_m = 0.0;    // mean depth of the five deepest significant pits
  double R10z_m = 0.0;   // R5p + R5v
  double Rcm10_m = 0.0;  // level at which 10 % is material, from the highest point: ≤ 0
  double Rcm50_m = 0.0;
  double Rcm90_m = 0.0;

  double length_m = 0.0;  // samples times spacing
  std::size_t samples = 0;
  std::size_t missing = 0;        // nan heights, left out of everything
  std::size_t sections_used = 0;  // of Rz
  std::size_t elements = 0;       // profile elements that RSm is the mean of
};

}  // namespace asperity
