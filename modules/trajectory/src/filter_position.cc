#include "asperity/trajectory/filter_position.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

// One axis: state (p, v) and its symmetric covariance.
struct AxisFilter {
  double p, v;
  double pp, pv, vv;

  void predict(double dt, double q_p, double q_pv, double q_v) {
    p += dt * v;
    pp += dt * (2.0 * pv + dt * vv) + q_p;
    pv += dt * vv + q_pv;
    vv += q_v;
  }

  void update(double z, double r) {
    const double gain_p = pp / (pp + r);
    const double gain_v = pv / (pp + r);
    const double residual = z - p;
    p += gain_p * residual;
    v += gain_v * residual;
    vv -= gain_v * pv;
    pv *= 1.0 - gain_p;
    pp *= 1.0 - gain_p;
  }
};

}  // namespace

FilteredPosition filter_position(std::span<const Eigen::Vector3d> measured_m, double period_s,
                                 const PositionFilterNoise& noise) {
  if (!(period_s > 0.0)) throw Error("position filter: period " + number_text(period_s) + " s is not positive");
  if (!(noise.measurement_m2.minCoeff() > 0.0))
    throw Error("position filter: the measurement variance must be positive");
  FilteredPosition out;
  out.p_m.resize(measured_m.size());
  out.v_mps.resize(measured_m.size());
  for (int axis = 0; axis < 3 && !measured_m.empty(); ++axis) {
    AxisFilter filter{measured_m[0][axis], 0.0, noise.measurement_m2[axis], 0.0, noise.initial_velocity_m2ps2[axis]};
    out.p_m[0][axis] = filter.p;
    out.v_mps[0][axis] = filter.v;
    for (std::size_t i = 1; i < measured_m.size(); ++i) {
      filter.predict(period_s, noise.process_position_m2[axis], noise.process_cross_m2ps[axis],
                     noise.process_velocity_m2ps2[axis]);
      filter.update(measured_m[i][axis], noise.measurement_m2[axis]);
      out.p_m[i][axis] = filter.p;
      out.v_mps[i][axis] = filter.v;
    }
  }
  return out;
}

}  // namespace asperity
