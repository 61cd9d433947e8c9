#pragma once

#include <limits>
#include <span>
#include <string>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"

namespace asperity {

struct StiffnessConfig {
  double high_cycles_per_mm = 0.12;
  double high_Hz = 5.0;
  double min_run_s = 1.0;
  double significance = 3.0;

  template <class V>
  void visit(V& v) {
    v.field("high_cycles_per_mm", high_cycles_per_mm, "the texture begins here: the band ends at this times the speed",
            {1e-3, 10.0});
    v.field("high_Hz", high_Hz, "upper end of the band at any speed", {0.1, 1e3});
    v.former("high_hz");
    v.field("min_run_s", min_run_s, "shortest time in contact that is used", {0.2, 1e3});
    v.field("significance", significance, "standard errors from which a compliance counts as measured", {1.0, 10.0});
  }
};

struct StiffnessEstimate {
  bool measured = false;  // the compliance is significant
  double stiffness_N_per_mm = std::numeric_limits<double>::quiet_NaN();
  double stiffness_stderr_N_per_mm = std::numeric_limits<double>::quiet_NaN();
  double lower_bound_N_per_mm =
      std::numeric_limits<double>::quiet_NaN();  // with 97.5 % confidence, always given with data
  double upper_bound_N_per_mm =
      std::numeric_limits<double>::quiet_NaN();  // likewise, with the lower one 95 %; if measured
  double compliance_mm_per_N = std::numeric_limits<double>::quiet_NaN();
  double compliance_stderr_mm_per_N = std::numeric_limits<double>::quiet_NaN();
  double degrees_of_freedom = std::numeric_limits<double>::infinity();  // of that standard error
  double force_rms_N = 0.0;                                             // of the force's variation in the band
  double band_high_hz = 0.0;
  double used_s = 0.0;
  std::string verdict;  // in words
};

// The contact's stiffness from how far the tip sinks when the force varies: h = texture - F/k + drift.
//
// Height and force are confounded in the texture's band: a bump lifts the hand, whose stiffness and mass
// answer with more force, so that height and force rise together there, with no sinking in it. The regression
// therefore stays below the texture, where the force varies because the hand presses differently. There
// the drift of the position is large, so it is a weighted one, frequency by frequency: each run in contact is
// freed of a straight line (a tilt of the base cannot be told from a force that rises evenly: a ramp helps by
// what it is not straight), tapered (Hann) and transformed; the compliance is the weighted least squares
// slope of -h on F with the inverse of the residual's own smoothed spectrum as weight. The standard error is
// that regression's with the taper's correlation between neighbours; it is honest for drift of any colour. What
// the slope is below 0 by is in it too: no surface rises under the force, so that much error was seen. If the slope is
// not significant, only the lower bound of the stiffness is to be used. A significantly negative one shows that
// texture dominates the band: nothing is then given.
//
// A base that is fitted to the same path takes part of the sinking with it: a force that rises along a round body is
// all but in its centre and radius. What the fit can take, rigid movements of the base and its radius, and waves up to
// `base_cycles_per_mm` where the base is a curve, is therefore taken from both height and force first, by least squares
// over the way travelled. Throws Error if the sizes differ.
StiffnessEstimate estimate_stiffness(const TipMotion& motion, const BasePath& base, std::span<const char> contact,
                                     const StiffnessConfig& config, double base_cycles_per_mm = 0.0);

}  // namespace asperity
