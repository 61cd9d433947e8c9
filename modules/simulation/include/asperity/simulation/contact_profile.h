#pragma once

#include <vector>

#include "asperity/simulation/contact_config.h"
#include "asperity/simulation/scan_base.h"
#include "asperity/simulation/scan_path.h"
#include "asperity/simulation/surface.h"

namespace asperity {

// The relief on the ground of a base, along a path, as the tip meets it, for every indentation that occurs: dilated by
// the tip, then smoothed by the contact disc, whose radius grows with the indentation as a = sqrt(r d) (Hertz).
class ContactProfile {
 public:
  // `greatest_force_N` bounds the indentations that are prepared.
  ContactProfile(const Surface& surface, const ScanBase& base, const ScanPath& path,
                 const SimulatedContactConfig& contact, double greatest_force_N);

  struct Value {
    double height_m = 0.0;
    double slope = 0.0;  // d height / d s
  };
  // At arc length `s_m`, pressed in by `indentation_m`; held beyond the margins of the path.
  Value at(double s_m, double indentation_m) const;

  static constexpr double kSpacing_m = 5e-6;
  static constexpr double kMargin_m = 3e-3;  // before s = 0 and after the end

 private:
  std::vector<std::vector<double>> levels_;  // by contact radius, `radius_step_m_` apart from 0
  double radius_step_m_ = 0.0;
  double tip_radius_m_ = 0.0;
};

}  // namespace asperity
