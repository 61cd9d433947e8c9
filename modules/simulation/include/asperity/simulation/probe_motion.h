#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/simulation/contact_profile.h"
#include "asperity/simulation/hand.h"
#include "asperity/simulation/scan_base.h"
#include "asperity/simulation/scan_path.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/simulation/surface.h"

namespace asperity {

// The true state of the probe at one instant of the integration.
struct MotionState {
  double t_s = 0.0;
  double s_m = 0.0;       // arc length along the path (erratum 23)
  double height_m = 0.0;  // of the tip above the base
  double normal_force_N = 0.0;
  double friction_N = 0.0;  // on the tip, against the direction of the path
  Eigen::Vector3d p_world_tip_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_world_marker = Eigen::Quaterniond::Identity();
  Eigen::Vector3d contact_force_world_N = Eigen::Vector3d::Zero();  // on the tip
};

// The probe in the hand on the object: hand, contact, friction and orientation, one fixed step after
// another (semi-implicit Euler). Along the normal
//   m h'' = F_c − F_hand,  F_c = max(0, k (z − h) + c (z' − h')),
// along the path a hand spring against LuGre friction and the relief's slope; orientation and lateral
// deviation follow the hand exactly (docs/virtual-bench.md). Before time begins the hand has held still on the
// object for half a second.
class ProbeMotion {
 public:
  // On the plane or cylinder of `config.shape`.
  ProbeMotion(const SimulationConfig& config, const Surface& surface);
  // On `base`; `config.hand.length_m` is the length of one stroke over it.
  ProbeMotion(const SimulationConfig& config, const Surface& surface, std::shared_ptr<const ScanBase> base);

  // The state now; the next call gives it one step later.
  MotionState next();

  double duration_s() const { return hand_.duration_s(); }
  const Hand& hand() const { return hand_; }
  const ScanPath& path() const { return path_; }

 private:
  // The state now, with this hand; moves on by one step.
  MotionState step(const HandState& hand);
  void advance(const HandState& hand);
  // The object under a tip that is off the path, less that on the path, which is in the profile.
  double ground_aside_m(const ScanPoint& on_path, double a_m, double v_m);

  SimulationConfig config_;
  std::shared_ptr<const ScanBase> base_;
  ScanPath path_;
  Hand hand_;
  ContactProfile profile_;
  Eigen::Quaterniond mean_tilt_;

  double s_m_ = 0.0, v_s_mps_ = 0.0, bristle_m_ = 0.0, friction_N_ = 0.0;
  double height_m_ = 0.0, v_h_mps_ = 0.0, force_N_ = 0.0;
  double rest_height_m_ = 0.0;  // to which the hand has adapted
  double damping_Ns_per_m_ = 0.0;
  double slope_ = 0.0;
  Ground ground_on_path_, ground_aside_;
  double aside_m_ = 0.0;
};

}  // namespace asperity
