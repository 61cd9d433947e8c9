#pragma once

#include "asperity/geometry/motion.h"
#include "asperity/profile/find_base_path.h"

namespace asperity {

struct LengthErrors {
  double place_m = 0.0;      // standard deviation of a place along the path, RMS over it
  double ends_m = 0.0;       // of the places at the path's ends
  double turned_m = 0.0;     // of the length, by noise of the places where the path turns
  double scale_sigma = 0.0;  // relative: what lasts along the path
  double bends_m = 0.0;      // of the length of all bends
};

// Standard errors of a path's arc length, by what a position error e does to L = ∫ t·dp: [t·e] at the ends and −∫ e·dt
// between, which is 2 t·e where a stroke turns round.
//
// `ends_m`: by the motion's covariance along the path at the ends of the rests, less the share of the tip's place in
// the marker, which is one error of all samples. `scale_sigma`, over the length: that one error, δ in the marker, moves
// the length by (Σ ΔRᵀt)·δ; the normals turn along the path by Θ (an arc's length over its radius), and what is not
// known of the level at which the tip goes changes it by Θ times that: `indentation_sigma_m`, 0.1 mm of the relief's
// own level, and the normal error of the path; and the ball's radius r over √3 times the angle by which the probe turns
// less than the normals, for it rolls. `turned_m`: the rest of e, of covariance C, fades with a correlation time of
// 0.5 s: Σᵢⱼ Δtᵢᵀ C Δtⱼ exp(−|tᵢ − tⱼ|/0.5 s). Steps of 1 mm, of 4 mm for this. `bends_m`: a quarter of what a
// direction that follows the bends closer adds to the length, for the next closer one would add or take again
// (docs/profile-bends.md). Zeros without a covariance.
LengthErrors measure_length_error(const TipMotion& motion, const BasePathResult& base,
                                  const Eigen::Vector3d& tip_in_marker_m, double tip_radius_m,
                                  double indentation_sigma_m);

}  // namespace asperity
