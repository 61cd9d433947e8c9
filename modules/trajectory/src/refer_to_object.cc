#include "asperity/trajectory/refer_to_object.h"

namespace asperity {

TipMotion refer_to_object(const TipMotion& motion, const ObjectMotion& object) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  TipMotion out;
  out.sigma_tip_in_marker_m = motion.sigma_tip_in_marker_m;
  out.noise = motion.noise;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (!object.is_seen(motion.t_ns[i])) continue;
    const ObjectState state = object.at(motion.t_ns[i]);
    const Eigen::Quaterniond back = state.T_world_object.rotation.conjugate();
    const Vector3d& omega = state.omega_radps;
    const Vector3d arm = motion.p_world_tip_m[i] - state.T_world_object.translation_m;
    const Vector3d slip = motion.v_world_tip_mps[i] - state.v_mps - omega.cross(arm);
    out.t_ns.push_back(motion.t_ns[i]);
    out.p_world_tip_m.push_back(back * arm);
    out.q_world_marker.push_back((back * motion.q_world_marker[i]).normalized());
    out.v_world_tip_mps.push_back(back * slip);
    out.a_world_tip_mps2.push_back(back * (motion.a_world_tip_mps2[i] - state.a_mps2 - state.alpha_radps2.cross(arm) -
                                           omega.cross(omega.cross(arm)) - 2.0 * omega.cross(slip)));
    if (!motion.cov_world_tip_m2.empty()) {
      const Matrix3d lever = skew(arm);
      const Matrix3d sum_m2 =
          motion.cov_world_tip_m2[i] + state.position_m2 + lever * state.rotation_rad2 * lever.transpose();
      const Matrix3d R = back.toRotationMatrix();
      out.cov_world_tip_m2.push_back(R * sum_m2 * R.transpose());
    }
    out.force_N.push_back(motion.force_N[i]);
    if (!motion.axial_force_N.empty()) out.axial_force_N.push_back(motion.axial_force_N[i]);
    if (!motion.force_world_N.empty()) out.force_world_N.push_back(back * motion.force_world_N[i]);
  }
  return out;
}

}  // namespace asperity
