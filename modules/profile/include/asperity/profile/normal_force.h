#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/nan.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"

namespace asperity {

enum class ForceSource { kNone, kAxial, kCorrectedAxial, kThreeAxes };
inline constexpr std::array<std::string_view, 4> kForceSourceNames{"none", "axial", "axial_corrected", "three_axes"};

// What is assumed of the friction where one axis of force is measured.
struct FrictionAssumption {
  double coefficient = 0.25;  // a hard tip on wood, plastics, paper, stone: 0.1 to 0.45
  double sigma = 0.12;        // standard deviation over materials
  double least_share = 0.3;   // of the normal force on the sensor's axis; with less it is not corrected
};

// The force on the tip along the outward normal.
struct NormalForce {
  std::vector<double> force_N;  // one a sample of the motion; nan where the sensor gave none
  ForceSource source = ForceSource::kNone;
  double share = kNan;             // axial reading over normal force, mean over the samples in contact and motion
  double relative_sigma = kNan;    // standard error of force_N that all samples have in common, relative to it
  double tangential_share = kNan;  // force against the motion over that along the normal, sums; three axes only
};

// The normal force under the tip. With three axes F: N = n·F. With the axial reading f alone, a the sensor's axis (from
// the tip towards the hand) and t the direction of travel along the surface, Coulomb's friction against the motion
// gives
//   f = a·F = N (a·n − µ a·t),
// solved for N with the assumed µ; the error is that of µ and of the normal, `normal_sigma_rad`. A tip that hardly
// moves (5 mm/s and below) has less of the friction's share, for its direction is not known then. Where the axis has
// less than `least_share` of the normal force, or is not known, the reading stays as it is.
// `axial_N` and `contact` have one entry a sample of `motion`. Throws Error if the sizes differ.
NormalForce find_normal_force(const TipMotion& motion, std::span<const double> axial_N, const BasePath& path,
                              std::span<const char> contact, const std::optional<Eigen::Vector3d>& axis_in_marker,
                              double normal_sigma_rad, const FrictionAssumption& assumed = {});

}  // namespace asperity
