#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/base/nan.h"

namespace asperity {

// Where a pass lies on a line that several share, by the positions of its path.
struct PassPlace {
  double start_m = 0.0;   // of its first point along the line
  bool backward = false;  // it goes against the line
  double reach_m = 1e-3;  // by which that may be wrong
};

// One stroke over a line of a surface, as a profile with what is known of its noise. Nothing of the noise was removed
// from its heights. Heights are nan in gaps.
struct ProfilePass {
  std::string name;
  double spacing_m = 0.025e-3;
  std::vector<double> texture_m;
  std::vector<double> slow_m;         // height less texture: what the high-pass took away; empty: not known
  std::vector<double> added_sigma_m;  // of the added noise, point by point; empty: the same everywhere
  // One-sided density of the added noise, m²/(cycles/mm), at rising frequencies; empty: not known.
  std::vector<double> frequency_cycles_per_mm;
  std::vector<double> noise_psd_m2_mm;
  double noise_relative = 0.3;     // standard error of that density's level, relative
  double place_sigma_m = kNan;     // of a place along the path, a shift of all not counted
  double scale_sigma = 0.0;        // relative, of all heights
  double along_sigma = kNan;       // relative, of lengths along the path
  double contact_rms_m = 0.0;      // of the noise that comes with the contact
  std::optional<PassPlace> place;  // nullopt: anywhere

  std::size_t size() const { return texture_m.size(); }
};

}  // namespace asperity
