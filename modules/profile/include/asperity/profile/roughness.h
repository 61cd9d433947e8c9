#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "asperity/base/nan.h"

namespace asperity {

// Parameters of a roughness profile, heights counted from its mean line. A parameter that the profile
// does not define (RSm without a whole profile element, Rsk of a flat profile) is nan.
struct RoughnessParameters {
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

  static constexpr RoughnessParameters unknown() {
    return {kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan};
  }
};

// One of them, for what is done with each.
struct RoughnessParameter {
  std::string_view name;
  std::string_view key;  // in files: with its unit
  double RoughnessParameters::*value;
  bool is_length = true;  // m, and grows with the heights; else a pure number
};

inline constexpr std::array<RoughnessParameter, 13> kRoughnessParameters{{
    {"Ra", "Ra_m", &RoughnessParameters::Ra_m},
    {"Rq", "Rq_m", &RoughnessParameters::Rq_m},
    {"Rz", "Rz_m", &RoughnessParameters::Rz_m},
    {"Rt", "Rt_m", &RoughnessParameters::Rt_m},
    {"Rsk", "Rsk", &RoughnessParameters::Rsk, false},
    {"Rku", "Rku", &RoughnessParameters::Rku, false},
    {"RSm", "RSm_m", &RoughnessParameters::RSm_m},
    {"R5p", "R5p_m", &RoughnessParameters::R5p_m},
    {"R5v", "R5v_m", &RoughnessParameters::R5v_m},
    {"R10z", "R10z_m", &RoughnessParameters::R10z_m},
    {"Rcm10", "Rcm10_m", &RoughnessParameters::Rcm10_m},
    {"Rcm50", "Rcm50_m", &RoughnessParameters::Rcm50_m},
    {"Rcm90", "Rcm90_m", &RoughnessParameters::Rcm90_m},
}};

struct RoughnessResult : RoughnessParameters {
  // Of the measurement of this stretch, noise and calibration in it (measure_roughness_under_noise.h); nan where not
  // known. That another stretch of the surface has other values is not in it.
  RoughnessParameters standard_error = RoughnessParameters::unknown();

  double length_m = 0.0;  // samples times spacing
  std::size_t samples = 0;
  std::size_t missing = 0;        // nan heights, left out of everything
  std::size_t sections_used = 0;  // of Rz
  std::size_t elements = 0;       // profile elements that RSm is the mean of
};

}  // namespace asperity
