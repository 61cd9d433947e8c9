#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise_sources.h"
#include "sensors.h"

namespace second_bench {

namespace {

using Eigen::Vector3d;
using Filter3 = Section<Vector3d>;
using Filter1 = Section<double>;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kGyroCountsPerDps = 16.4;

Filter3 filter3(Filter3::Kind kind, double f0_Hz, double q) { return {kind, f0_Hz, q, 1.0 / kStep_s}; }

Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

// When the host learns of each sample, and what it writes down.
class HostClock {
 public:
  HostClock(const ScanPlan& plan, Dice& dice) : plan_(plan), dice_(dice) {}

  std::vector<double> stamps_s(const std::vector<double>& t_s) {
    std::vector<double> out(t_s.size());
    if (plan_.batch_s > 0.0) {
      const auto size = std::max<std::size_t>(1, static_cast<std::size_t>(plan_.batch_s * plan_.rate_Hz));
      for (std::size_t first = 0; first < t_s.size(); first += size) {
        const std::size_t last = std::min(first + size, t_s.size()) - 1;
        // USB: half a frame, the scheduler's wait, at times a long one.
        double arrival_s = t_s[last] + 0.5e-3 + dice_.exponential(0.2e-3);
        if (dice_.chance(0.01)) arrival_s += dice_.uniform(1e-3, 6e-3);
        for (std::size_t i = first; i <= last; ++i) out[i] = arrival_s - static_cast<double>(last - i) / plan_.rate_Hz;
      }
    } else {
      // The host's line through the probe's own clock: it wanders a little.
      GaussMarkov line(plan_.stamp_jitter_s, 2.0, dice_);
      for (std::size_t i = 0; i < t_s.size(); ++i) {
        out[i] = t_s[i] + line.step(1.0 / plan_.rate_Hz, dice_) + plan_.stamp_jitter_s * dice_.normal();
        if (plan_.stamp_step_s > 0.0) out[i] += dice_.exponential(0.5e-3);
      }
    }
    if (plan_.stamp_step_s > 0.0) {
      for (double& stamp : out) stamp = plan_.stamp_step_s * std::ceil(stamp / plan_.stamp_step_s);
    }
    const double least_s = plan_.stamp_step_s > 0.0 ? plan_.stamp_step_s : 1e-6;
    for (std::size_t i = 1; i < out.size(); ++i) out[i] = std::max(out[i], out[i - 1] + least_s);
    return out;
  }

 private:
  const ScanPlan& plan_;
  Dice& dice_;
};

struct Signals {
  std::vector<Vector3d> accel_mps2, omega_radps;  // after the sensors' filters
  std::vector<double> force_N;
};

Signals sense(const ScanPlan& plan, const HandMotion& motion) {
  const std::size_t n = motion.size();
  const Vector3d lever_m = plan.sensor_in_marker_m - plan.tip_in_marker_m;
  const Vector3d axis = -plan.tip_in_marker_m.normalized();
  Filter3 resonance = filter3(Filter3::Kind::kLowPass, plan.resonance_Hz, plan.resonance_q);
  const auto kind = plan.open ? Filter3::Kind::kLowPass : Filter3::Kind::kOnePole;
  Filter3 anti_alias = filter3(kind, plan.filter_Hz, plan.filter_q);
  Filter3 gyro_filter = filter3(Filter3::Kind::kLowPass, plan.filter_Hz, 0.7);
  Filter1 force_filter(Filter1::Kind::kLowPass, plan.force_filter_Hz, 0.6, 1.0 / kStep_s);
  Signals out;
  out.accel_mps2.resize(n);
  out.omega_radps.resize(n);
  out.force_N.resize(n);
  const auto sensor_m = [&](std::size_t i) {
    return Vector3d(motion.p_world_tip_m[i] + motion.q_world_marker[i] * lever_m);
  };
  const double square_s2 = kStep_s * kStep_s;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Eigen::Quaterniond back = motion.q_world_marker[i].conjugate();
    const Vector3d a_mps2 = (sensor_m(i + 1) - 2.0 * sensor_m(i) + sensor_m(i - 1)) / square_s2;
    const Vector3d a_tip_mps2 =
        (motion.p_world_tip_m[i + 1] - 2.0 * motion.p_world_tip_m[i] + motion.p_world_tip_m[i - 1]) / square_s2;
    const Vector3d f_mps2 = back * (a_mps2 - kGravity_world_mps2);
    const Vector3d omega_radps =
        rotation_vector(motion.q_world_marker[i - 1].conjugate() * motion.q_world_marker[i + 1]) / (2.0 * kStep_s);
    // Between the tip and the force sensor sits a little mass.
    const double force_N =
        axis.dot(back * (motion.contact_world_N[i] - plan.tip_mass_kg * (a_tip_mps2 - kGravity_world_mps2)));
    if (i == 1) {
      resonance.settle(f_mps2);
      anti_alias.settle(f_mps2);
      gyro_filter.settle(omega_radps);
      force_filter.settle(force_N);
    }
    out.accel_mps2[i] = anti_alias.push(resonance.push(f_mps2));
    out.omega_radps[i] = gyro_filter.push(omega_radps);
    out.force_N[i] = force_filter.push(force_N);
  }
  return out;
}

}  // namespace

TrueSensors draw_sensors(const ScanPlan& plan) {
  Dice dice(plan.seed, 31);
  TrueSensors out;
  const double counts_per_mps2 = plan.accel_counts_per_g / kGravity_mps2;
  const Eigen::Quaterniond mounted =
      plan.open ? Eigen::Quaterniond(Eigen::AngleAxisd(0.02 * dice.normal(), dice.normal3().normalized()))
                : Eigen::Quaterniond(Eigen::AngleAxisd(dice.uniform(0.0, 3.0), dice.normal3().normalized()));
  const auto uneven = [&] {
    Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) m(r, c) += 0.006 * dice.normal();
    }
    return m;
  };
  out.accel_B = counts_per_mps2 * uneven() * mounted.toRotationMatrix();
  out.accel_C = counts_per_mps2 * 0.15 * dice.normal3();
  if (!plan.open) out.accel_C += Vector3d::Constant(0.5 * (plan.adc_min + plan.adc_max));
  out.gyro_B = kGyroCountsPerDps / kDegree_rad * uneven() * mounted.toRotationMatrix();
  out.gyro_C = kGyroCountsPerDps * 0.4 * dice.normal3();
  out.force_newton_per_count = plan.force_newton_per_count;
  out.force_offset_N = plan.open ? 0.2 * dice.normal() : -1.0 - 0.3 * dice.uniform();
  return out;
}

ProbeRows sample_probe(const ScanPlan& plan, const TrueSensors& sensors, const HandMotion& motion) {
  Dice dice(plan.seed, 41), noise(plan.seed, 42), faults(plan.seed, 43);
  const Signals signals = sense(plan, motion);
  // The probe's crystal is off, and drifts as it warms.
  const double rate_Hz = plan.rate_Hz * (1.0 + 50e-6 * dice.normal());
  std::vector<double> t_s;
  const double end_s = static_cast<double>(motion.size() - 4) * kStep_s;
  for (double t = 2e-3; t < end_s; t += (1.0 + 2e-6 * std::sin(0.3 * t)) / rate_Hz) t_s.push_back(t);
  std::vector<double> stamp_s = HostClock(plan, dice).stamps_s(t_s);
  double delay_s = 0.0;
  for (std::size_t k = 0; k < t_s.size(); ++k) delay_s += (stamp_s[k] - t_s[k]) / static_cast<double>(t_s.size());

  const double band_Hz = plan.open ? std::min(0.5 * plan.rate_Hz, 1.1 * plan.filter_Hz) : 1.57 * plan.filter_Hz;
  const double accel_sigma = plan.accel_noise_mps2_per_rtHz * std::sqrt(band_Hz);
  const double gyro_sigma = plan.gyro_noise_radps_per_rtHz * std::sqrt(band_Hz);
  std::vector<Flicker> flicker;
  for (int axis = 0; axis < 6; ++axis)
    flicker.emplace_back(axis < 3 ? plan.accel_flicker_mps2 : plan.gyro_flicker_radps, noise);
  const Vector3d drift_mps2 = plan.accel_drift_mps2 * noise.normal3();
  const double warms_s = noise.uniform(2.0, 30.0);
  const auto count = [&](double value) { return std::clamp(std::round(value), plan.adc_min, plan.adc_max); };

  ProbeRows out;
  double force_due = 1.0;
  int lost = 0;
  const double dt_s = 1.0 / plan.rate_Hz;
  for (std::size_t k = 0; k < t_s.size(); ++k) {
    const double place = t_s[k] / kStep_s;
    const auto i = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(i);
    const auto between = [&](const auto& list) { return (list[i] + share * (list[i + 1] - list[i])).eval(); };
    Vector3d f_mps2 = between(signals.accel_mps2) + drift_mps2 * (1.0 - std::exp(-t_s[k] / warms_s));
    Vector3d omega_radps = between(signals.omega_radps);
    for (int axis = 0; axis < 3; ++axis) {
      f_mps2[axis] += accel_sigma * noise.normal() + flicker[static_cast<std::size_t>(axis)].step(dt_s, noise);
      omega_radps[axis] += gyro_sigma * noise.normal() + flicker[static_cast<std::size_t>(axis + 3)].step(dt_s, noise);
    }
    ProbeRow row;
    row.accel = (sensors.accel_B * f_mps2 + sensors.accel_C).unaryExpr(count);
    row.gyro = (sensors.gyro_B * omega_radps + sensors.gyro_C).unaryExpr(count);
    if (force_due >= 1.0) {
      force_due -= 1.0;
      const double force_N = signals.force_N[i] + plan.force_noise_N * noise.normal();
      row.force = count((force_N - sensors.force_offset_N) / sensors.force_newton_per_count);
    }
    force_due = std::min(force_due + plan.force_rate_Hz / plan.rate_Hz, 2.0);
    out.taken.push_back({kStart_ns + std::llround(1e9 * (t_s[k] + delay_s)), i});
    if (faults.chance(plan.spike_chance)) {
      const auto any = [&](double) { return std::round(faults.uniform(plan.adc_min, plan.adc_max)); };
      row.accel = row.accel.unaryExpr(any);
      row.gyro = row.gyro.unaryExpr(any);
      if (std::isfinite(row.force)) row.force = any(0.0);
    }
    if (lost == 0 && faults.chance(plan.lost_chance)) lost = 1 + static_cast<int>(faults.exponential(8.0));
    if (lost > 0) {
      --lost;
      continue;
    }
    row.t_ns = kStart_ns + std::llround(1e9 * stamp_s[k]);
    out.rows.push_back(row);
  }
  return out;
}

}  // namespace second_bench
