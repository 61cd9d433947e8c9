#include "transition_sum.h"

#include <cstddef>

#include "asperity/base/processor.h"

namespace asperity::inertial_smoother {

namespace {

using Four = TransitionSum::Four;
using Sums = TransitionSum::Sums;

// What a segment's columns come from, in the same fours.
struct Segment {
  double dt = 0.0, half = 0.0;  // s, s²/2
  Four R0[3];                   // columns
  Four A;
  Vector3d f_marker = Vector3d::Zero(), w = Vector3d::Zero();
  bool accel_matrix = false, gyro_matrix = false;
};

void set(Four& to, const Vector3d& from) { to = Four{from[0], from[1], from[2], 0.0}; }

// out = A × c.
[[gnu::always_inline]] inline void cross(const Four& A_yzx, const Four& A_zxy, const Four& c, Four& out) {
  out = A_yzx * __builtin_shufflevector(c, c, 2, 0, 1, 3) - A_zxy * __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

[[gnu::always_inline]] inline void add_segment(const Segment& s, Sums& to) {
  const Four A_yzx = __builtin_shufflevector(s.A, s.A, 1, 2, 0, 3),
             A_zxy = __builtin_shufflevector(s.A, s.A, 2, 0, 1, 3);
  Four leak;
  if (s.accel_matrix) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) {
        const int at = 3 * axis + c;
        const Four force = s.f_marker[axis] * s.R0[c];
        to.pEa[at] += s.dt * to.vEa[at] + s.half * force;
        to.vEa[at] += s.dt * force;
      }
    }
  }
  if (s.gyro_matrix) {
    for (int axis = 0; axis < 3; ++axis) {
      const double share = 0.5 * s.dt * s.w[axis];
      for (int c = 0; c < 3; ++c) {
        const int at = 3 * axis + c;
        const Four turned = share * s.R0[c];
        cross(A_yzx, A_zxy, to.phiEg[at] + turned, leak);
        to.pEg[at] += s.dt * to.vEg[at] - s.half * leak;
        to.vEg[at] -= s.dt * leak;
        to.phiEg[at] += 2.0 * turned;
      }
    }
  }
  const double middle = 0.5 * s.dt;
  for (int c = 0; c < 3; ++c) {
    cross(A_yzx, A_zxy, to.g1[c] + middle * s.R0[c], leak);
    to.pbg[c] += s.dt * to.vbg[c] + s.half * leak;
    to.vbg[c] += s.dt * leak;
    to.g2[c] += s.dt * to.g1[c] + s.half * s.R0[c];
    to.g1[c] += s.dt * s.R0[c];
  }
  to.sp += s.dt * to.sv + s.half * s.A;
  to.sv += s.dt * s.A;
}

ASPERITY_TARGET_AVX2 void add_segment_avx2(const Segment& s, Sums& to) { add_segment(s, to); }

template <int Columns>
Eigen::Matrix<double, 3, Columns> columns(const Four (&from)[Columns]) {
  Eigen::Matrix<double, 3, Columns> out;
  for (int c = 0; c < Columns; ++c) {
    for (int r = 0; r < 3; ++r) out(r, c) = from[c][r];
  }
  return out;
}

}  // namespace

void TransitionSum::extend(const Step& s, const Knot& k0, const Knot& k1, const Mounting& mounting,
                           bool gyro_turns_too) {
  Segment segment;
  const double dt = segment.dt = k1.t - k0.t;
  const double half = segment.half = 0.5 * dt * dt;
  for (int c = 0; c < 3; ++c) set(segment.R0[c], s.R0.col(c));
  set(segment.A, s.A);
  segment.accel_matrix = layout_->accel_matrix >= 0;
  segment.gyro_matrix = layout_->gyro_matrix >= 0;
  if (segment.accel_matrix) segment.f_marker = mounting.accel * (0.5 * (k0.f + k1.f));
  segment.w = s.w;
  if (kProcessorHasAvx2) {
    add_segment_avx2(segment, sums_);
  } else {
    add_segment(segment, sums_);
  }
  Transition& to = rest_;
  if (layout_->misalignment >= 0) {
    const Vector3d f_marker = mounting.accel * (0.5 * (k0.f + k1.f));
    const Matrix3d force = -(s.R0 * skew(f_marker)) - skew(s.A) * to.phimu;
    to.pmu += dt * to.vmu + half * force;
    to.vmu += dt * force;
    if (gyro_turns_too) to.phimu -= dt * s.R0 * skew(s.w);
  }
  for (std::size_t c = 0; c < to.accel.size(); ++c) to.accel[c].add(k0.accel_psd[c] * dt, dt);
  to.fast.add(dt * k0.accel_fast.cast<double>(), dt);
  to.marker_from_sensor = mounting.accel;
  for (std::size_t c = 0; c < to.turn.size(); ++c) to.turn[c] += k0.gyro_psd[c] * dt;
  to.T += dt;
}

Transition TransitionSum::transition() const {
  Transition out = rest_;
  const auto vector = [](const Four& from) { return Vector3d(from[0], from[1], from[2]); };
  out.sv = vector(sums_.sv);
  out.sp = vector(sums_.sp);
  out.g1 = columns(sums_.g1);
  out.g2 = columns(sums_.g2);
  out.vbg = columns(sums_.vbg);
  out.pbg = columns(sums_.pbg);
  if (layout_->accel_matrix >= 0) {
    out.vEa = columns(sums_.vEa);
    out.pEa = columns(sums_.pEa);
  }
  if (layout_->gyro_matrix >= 0) {
    out.phiEg = columns(sums_.phiEg);
    out.vEg = columns(sums_.vEg);
    out.pEg = columns(sums_.pEg);
  }
  return out;
}

}  // namespace asperity::inertial_smoother
