#pragma once

#include <span>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "asperity/profile/profile.h"

namespace asperity {

struct ProfileConfig {
  double spacing_m = 0.025e-3;
  double cutoff_cycles_per_mm = 0.1;
  double max_hole_m = 0.6e-3;
  double bridge_m = 2e-3;
  double max_stop_s = 1.0;
  double max_force_hole_s = 0.05;
  bool remove_noise = true;
  double contact_resonance_Hz = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("spacing_m", spacing_m, "of the profile's points", {1e-7, 1e-2});
    v.field("cutoff_cycles_per_mm", cutoff_cycles_per_mm,
            "high-pass of texture_m, -3 dB of the whole filter; 0 for none", {0.0, 10.0});
    v.field("max_hole_m", max_hole_m, "distance between samples that is still interpolated", {1e-7, 1.0});
    v.field("bridge_m", bridge_m, "gap across which the high-pass continues", {0.0, 1.0});
    v.field("max_stop_s", max_stop_s, "a longer pause divides the profile, because the drift has changed", {0.01, 1e4});
    v.field("max_force_hole_s", max_force_hole_s, "time between force readings that is still interpolated",
            {0.0, 10.0});
    v.field("remove_noise", remove_noise, "remove the expected noise from the heights (Wiener's filter)");
    v.field("contact_resonance_Hz", contact_resonance_Hz,
            "of the probe's mass on the contact, where it is known: heights are the surface's then, not the tip's; 0: "
            "they are the tip's",
            {0.0, 1e4});
  }
};

// The tip's height over the base path along its outward normal, evenly spaced in arc length (seed §5.1).
// `usable`, empty or one a sample, marks samples in contact.
//
// Samples are sorted by s, averaged where they are denser than a quarter of the spacing, interpolated by a
// cubic spline and band-limited to the spacing (resample_over_path.h). Heights are nan where contact was
// lost or samples lie further apart than max_hole_m. A rest shorter than max_stop_s leaves no trace but
// more averaging (one before or after the path is left out but for 20 ms); a longer one parts the profile by one nan
// point and a new run of the high-pass, for the position's slow error has moved on. sigma_m is the position's standard
// deviation along the normal: averaging does not lower it, because a smoother's errors last far longer than a cell.
// Throws Error if the sizes differ or nothing is usable.
Profile make_profile(const TipMotion& motion, const BasePath& base, std::span<const char> usable,
                     const ProfileConfig& config);

}  // namespace asperity
