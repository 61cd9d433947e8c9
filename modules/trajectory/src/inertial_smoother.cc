#include "inertial_smoother.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "inertial_forward.h"
#include "inertial_model.h"
#include "stream_agreement.h"
#include "symmetric_products.h"

namespace asperity::inertial_smoother {

namespace {

using TipRows = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax>;

Matrix3d tip_covariance(const Problem& problem, const Nominal& smoothed, const Square& P, const Square& Lambda,
                        const Vector3d& tip_in_marker) {
  const Layout& layout = problem.layout;
  const Matrix3d R = smoothed.q.toRotationMatrix();
  const Matrix3d turn = -skew(R * (tip_in_marker - smoothed.lever));
  TipRows JP = P.middleRows<3>(kP) + turn * P.middleRows<3>(kPhi);
  if (layout.lever >= 0) JP -= R * P.middleRows<3>(layout.lever);
  Matrix3d JPJ = JP.middleCols<3>(kP) + JP.middleCols<3>(kPhi) * turn.transpose();
  if (layout.lever >= 0) JPJ -= JP.middleCols<3>(layout.lever) * R.transpose();
  // The tip's own place in the marker shows nowhere in the data: considered, not estimated.
  return JPJ - rows_times<3>(JP, Lambda) * JP.transpose() +
         R * problem.tip_sigma_m.cwiseAbs2().asDiagonal() * R.transpose();
}

// The adjoint of Bryson and Frazier with its covariance, on its way back.
struct Adjoint {
  State lambda;
  Square Lambda;

  // Over a pose: λ̃ = Cᵀ λ̂ − Hᵀ S⁻¹ y and Λ̃ = Cᵀ Λ̂ C + Hᵀ S⁻¹ H with C = I − K H; what it says of the pose's noise.
  void pass_pose(const Problem& problem, const Record& record, std::size_t pose, const Square& P, NoiseScore& score) {
    const Layout& layout = problem.layout;
    const Jacobian H = record.predicted.jacobian(layout);
    const Jacobian K = record.N_inverse.lazyProduct(record.predicted.times(P, layout));  // Kᵀ
    const Vector6d u = record.S_inverse * record.predicted.residual + K.lazyProduct(lambda);
    const Jacobian KL = rows_times<6>(K, Lambda);
    const Matrix6d D = KL.lazyProduct(K.transpose()) + record.S_inverse;
    if (record.believed) add_pose_score(problem, record, pose, u, D, score);
    lambda -= H.transpose().lazyProduct(u);
    // Hᵀ D H − Λ K H − its transpose, as Hᵀ W + Wᵀ H.
    Rows<12> A(12, H.cols()), B(12, H.cols());
    B.topRows<6>() = 0.5 * D.lazyProduct(H) - KL;
    A.topRows<6>() = B.bottomRows<6>() = H;
    A.bottomRows<6>() = B.topRows<6>();
    add_transposed_product<12>(1.0, A, B, Lambda);
  }

  static void add_pose_score(const Problem& problem, const Record& record, std::size_t pose, const Vector6d& u,
                             const Matrix6d& D, NoiseScore& score) {
    const MeasurementNoise noise = measurement_noise(problem, pose, record.predicted.rate);
    constexpr std::array<Component, 3> kPosition{kPositionX, kPositionY, kPositionZ};
    constexpr std::array<Component, 3> kRotation{kRotationX, kRotationY, kRotationZ};
    const Vector3d position = noise.position * u.head<3>(), rotation = noise.rotation * u.tail<3>();
    const Matrix3d position_mean = noise.position * D.topLeftCorner<3, 3>();
    const Matrix3d rotation_mean = noise.rotation * D.bottomRightCorner<3, 3>();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      score.add(kPosition[a], u[axis] * position[axis], position_mean(axis, axis));
      score.add(kRotation[a], u[3 + axis] * rotation[axis], rotation_mean(axis, axis));
    }
    score.add(kPoseTime, std::pow(noise.timing.dot(u), 2), noise.timing.dot(D * noise.timing));
  }
};

// Shares the small second-order difference between the end of one interval and the start of the next
// over the interval, so that the path has no steps.
struct Seam {
  Vector3d p = Vector3d::Zero();
  Vector3d v = Vector3d::Zero();
  Vector3d phi = Vector3d::Zero();
};

// One interval between two epochs.
struct Interval {
  std::size_t first = 0;  // knots
  std::size_t last = 0;
  std::vector<Knot> knots;  // from the first to the last
  std::vector<Step> steps;
  std::vector<Nominal> path;
  std::vector<Noise> noises;
};

// Runs from the filtered start.
void run_interval(const Problem& problem, Nominal x, Interval& interval) {
  const Mounting mounting = mounting_of(x, problem);
  interval.knots.clear();
  for (std::size_t k = interval.first; k <= interval.last; ++k) interval.knots.push_back(problem.knots[k]);
  interval.steps.clear();
  for (std::size_t k = 0; k + 1 < interval.knots.size(); ++k)
    interval.steps.push_back(advance_state(x, interval.knots[k], interval.knots[k + 1], mounting, nullptr));
}

// Inside the interval the smoothed motion is the dead reckoning from its smoothed start with the smoothed noise
// −Q Gᵀ λ(t) as a further input (Bryson and Frazier's form of the smoother). Writes the samples before `place`.
void write_interval(const Problem& problem, const State& lambda_end, const Nominal& start, const Nominal& next,
                    Interval& interval, std::size_t& place, Smoothed& out) {
  const std::vector<Knot>& knots = interval.knots;
  std::vector<Step>& steps = interval.steps;
  const Vector3d lp = lambda_end.segment<3>(kP);
  Vector3d lv = lambda_end.segment<3>(kV);
  Vector3d lphi = lambda_end.segment<3>(kPhi);
  Vector3d lbg = lambda_end.segment<3>(kBg);
  interval.noises.resize(steps.size());
  const double rate = rate_walk_density(problem), along = fast_density_factor(problem);
  const Mounting mounting = mounting_of(start, problem);
  for (std::size_t k = steps.size(); k-- > 0;) {
    const Knot& knot = knots[k];
    const double dt = knots[k + 1].t - knot.t;
    const Step& step = steps[k];
    Noise& noise = interval.noises[k];
    const Vector3d middle = lv + 0.5 * dt * lp;
    const Matrix3d world = step.R0 * mounting.accel;
    const Vector3d fast = world * (symmetric(knot.accel_fast.cast<double>()) * (world.transpose() * middle));
    noise.dv = -dt * (accel_density(knot, problem) * middle + along * fast);
    noise.dphi = -gyro_density(knot, problem) * dt * lphi;
    noise.dbg = -rate * dt * (lbg - 0.5 * dt * (step.R0.transpose() * lphi));
    lbg -= dt * (step.R0.transpose() * lphi);
    lphi += step.A.cross(dt * lv + 0.5 * dt * dt * lp);
    lv += dt * lp;
  }
  Nominal x = start;
  interval.path.resize(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    interval.path[k] = x;
    steps[k] = advance_state(x, knots[k], knots[k + 1], mounting, &interval.noises[k]);
  }
  Seam seam;
  seam.p = next.p - x.p;
  seam.v = next.v - x.v;
  seam.phi = log_rotation(next.q * x.q.conjugate());
  const double t0 = knots.front().t;
  const double T = knots.back().t - t0;
  for (std::size_t k = steps.size(); k-- > 0;) {
    const Knot& knot = knots[k];
    if (knot.sample < 0) continue;
    const double share = (knot.t - t0) / T;
    const Nominal& at = interval.path[k];
    --place;
    out.sample[place] = knot.sample;
    out.p[place] = at.p + share * seam.p;
    out.v[place] = at.v + share * seam.v;
    out.q[place] = (exp_rotation(share * seam.phi) * at.q).normalized();
    out.a[place] = steps[k].a0;
    out.omega_world[place] = steps[k].R0 * steps[k].omega0;
  }
}

void write_last_sample(const Problem& problem, const Knot& knot, const Nominal& smoothed, std::size_t& place,
                       Smoothed& out) {
  if (knot.sample < 0) return;
  const Mounting mounting = mounting_of(smoothed, problem);
  --place;
  out.sample[place] = knot.sample;
  out.p[place] = smoothed.p;
  out.v[place] = smoothed.v;
  out.q[place] = smoothed.q;
  out.a[place] = smoothed.q * (mounting.accel * knot.f - smoothed.ba) + mounting.gravity;
  out.omega_world[place] = smoothed.q * (mounting.gyro * knot.w - smoothed.bg);
}

void add_residual(const Problem& problem, const Knot& knot, const Nominal& smoothed, std::size_t pose, Smoothed& out) {
  const Vector3d omega = mounting_of(smoothed, problem).gyro * knot.w - smoothed.bg;
  const Predicted predicted = predict_pose(smoothed, omega, problem.poses[pose]);
  const Vector3d position = predicted.residual.head<3>(), rotation = predicted.residual.tail<3>();
  const Matrix6d noise = measurement_noise(problem, pose, predicted.rate).covariance(1.0, 1.0);
  out.position_residual[pose] = position;
  out.rotation_residual[pose] = rotation;
  out.position_chi2[pose] = position.dot(noise.topLeftCorner<3, 3>().ldlt().solve(position));
  out.rotation_chi2[pose] = rotation.dot(noise.bottomRightCorner<3, 3>().ldlt().solve(rotation));
}

void make_room(const Problem& problem, bool path, Smoothed& out) {
  if (path) {
    std::size_t samples = 0;
    for (std::size_t k = 0; k < problem.knots.size(); ++k) samples += problem.knots.sample(k) >= 0;
    out.sample.resize(samples);
    out.p.resize(samples);
    out.v.resize(samples);
    out.a.resize(samples);
    out.omega_world.resize(samples);
    out.q.resize(samples);
    out.epoch_t.resize(problem.epochs.size());
    out.tip_covariance.resize(problem.epochs.size());
  }
  out.position_residual.assign(problem.poses.size(), Vector3d::Zero());
  out.rotation_residual.assign(problem.poses.size(), Vector3d::Zero());
  out.position_chi2.assign(problem.poses.size(), 0.0);
  out.rotation_chi2.assign(problem.poses.size(), 0.0);
}

}  // namespace

Smoothed smooth_motion(const Problem& problem, const Vector3d& tip_in_marker, bool path, const Observer& observer) {
  const int n = problem.layout.size;
  ForwardRecords records(problem, observer);
  const std::size_t epochs = records.size();

  Smoothed out;
  make_room(problem, path, out);
  const std::size_t checkpoint = std::min(problem.checkpoint_epoch, epochs - 1);
  out.last_sigma = records.at(epochs - 1).covariance(n).diagonal().cwiseMax(0.0).cwiseSqrt();

  Adjoint adjoint{State::Zero(n), Square::Zero(n, n)};  // after the epoch in hand
  Interval interval;
  Nominal next;  // the smoothed state at the epoch after the one in hand
  std::size_t place = out.sample.size();
  auto restart = problem.restarts.rbegin();

  for (std::size_t e = epochs; e-- > 0;) {
    const Record& record = records.at(e);
    const State lambda_end = adjoint.lambda;  // where the interval that begins here ends, before that epoch's pose
    interval.first = problem.epochs[e].knot;
    interval.last = e + 1 < epochs ? problem.epochs[e + 1].knot : interval.first;
    if (restart != problem.restarts.rend() && restart->epoch == e + 1) {
      restart_back(problem, *restart++, adjoint.lambda, adjoint.Lambda, out.score);
    } else if (e + 1 < epochs) {
      if (path) run_interval(problem, record.x, interval);
      const Transition& transition = record.transition;
      transition.add_score(problem, adjoint.lambda, adjoint.Lambda, out.score);
      transition.propagate_back(problem, transition.rows(problem.layout), adjoint.lambda, adjoint.Lambda);
    }

    const Square P = record.covariance(n);
    if (e == checkpoint) out.checkpoint = {record.x, P, record.refused_in_a_row};
    Nominal smoothed = record.x;
    apply_correction(-(P * adjoint.lambda), problem.layout, smoothed);
    const Knot knot = problem.knots[interval.first];
    const std::int64_t pose = problem.epochs[e].pose;
    if (pose >= 0) add_residual(problem, knot, smoothed, static_cast<std::size_t>(pose), out);
    if (path) {
      out.tip_covariance[e] = tip_covariance(problem, smoothed, P, adjoint.Lambda, tip_in_marker);
      out.epoch_t[e] = knot.t;
      if (e + 1 < epochs) {
        write_interval(problem, lambda_end, smoothed, next, interval, place, out);
      } else {
        write_last_sample(problem, knot, smoothed, place, out);
      }
    }
    if (e + 1 == epochs) out.last = smoothed;
    next = smoothed;
    if (e == 0) out.first = smoothed;
    if (record.updated) adjoint.pass_pose(problem, record, static_cast<std::size_t>(pose), P, out.score);
    if (e % 256 == 0) observer.update("smoother", 1.0 - static_cast<double>(e) / static_cast<double>(epochs));
  }
  add_start_score(problem, adjoint.lambda, adjoint.Lambda, out.score);
  if (path) out.agreement = compare_streams(problem, records, out);
  return out;
}

}  // namespace asperity::inertial_smoother
