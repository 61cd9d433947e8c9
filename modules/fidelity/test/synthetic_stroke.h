#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/fidelity/score_realism.h"

namespace asperity::realism_test {

// A mass on a contact's spring and damper that is led over a sum of sines at an even speed, held by a hand with spring
// and damper: linear as long as contact is kept, so everything is a sum of sines in closed form.
struct LinearStroke {
  static constexpr double kHeightNoise_m = 0.2e-6;
  double mass_kg = 0.05, hand_damping = 3.0, hand_stiffness = 250.0;
  double stiffness = 2e5, damping_ratio = 0.15;
  double speed_mps = 0.025, length_m = 80e-3, force_N = 0.8, rate_Hz = 4000.0;

  struct Wave {
    double cycles_per_m, amplitude_m, phase;
  };
  std::vector<Wave> waves;

  // `count` waves between the frequencies with random phases; RMS of the sum `rms_m`.
  void add_waves(int count, double low_cycles_per_mm, double high_cycles_per_mm, double rms_m, std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      waves.push_back({1e3 * random.uniform(low_cycles_per_mm, high_cycles_per_mm),
                       rms_m * std::sqrt(2.0 / static_cast<double>(count)),
                       random.uniform(0.0, 2.0 * std::numbers::pi)});
    }
  }

  double relief_m(double s_m) const {
    double sum = 0.0;
    for (const Wave& w : waves)
      sum += w.amplitude_m * std::sin(2.0 * std::numbers::pi * w.cycles_per_m * s_m + w.phase);
    return sum;
  }

  // Tip height over relief at ω: (k + jωc) / (k + k_h − mω² + jω(c + c_h)).
  std::complex<double> response(double omega) const {
    const double c = 2.0 * damping_ratio * std::sqrt(stiffness * mass_kg);
    const std::complex<double> up(stiffness, omega * c);
    const std::complex<double> down(stiffness + hand_stiffness - mass_kg * omega * omega, omega * (c + hand_damping));
    return up / down;
  }

  struct State {
    double height_m = 0.0, climb_mps = 0.0, accel_mps2 = 0.0, force_N = 0.0;
  };
  State at(double t_s) const {
    State out;
    for (const Wave& w : waves) {
      const double omega = 2.0 * std::numbers::pi * w.cycles_per_m * speed_mps;
      const std::complex<double> h =
          response(omega) * std::polar(w.amplitude_m, omega * t_s + w.phase) * std::complex<double>(0.0, -1.0);
      const std::complex<double> v = h * std::complex<double>(0.0, omega), a = v * std::complex<double>(0.0, omega);
      out.height_m += h.real();
      out.climb_mps += v.real();
      out.accel_mps2 += a.real();
      out.force_N += mass_kg * a.real() + hand_damping * v.real() + hand_stiffness * h.real();
    }
    out.force_N += force_N;
    return out;
  }

  // As `process` would give it: along x over the plane z = 0, one force reading in ten samples, the force sensor's axis
  // along the normal; noise of the accelerations is white, and so is that of the heights, 0.2 µm, which is stated.
  RealStroke measured(const std::string& name, double accel_noise_mps2 = 0.0, std::uint64_t seed = 1) const {
    RealStroke out;
    out.name = name;
    out.calibration.tip_in_marker_m = {0.0, 0.0, -0.1};
    Random random(seed, 5);
    ProcessResult& r = out.result;
    const auto count = static_cast<int>(length_m / speed_mps * rate_Hz);
    for (int i = 0; i <= count; ++i) {
      const double t_s = i / rate_Hz, s_m = speed_mps * t_s;
      const State state = at(t_s);
      TipMotion& motion = r.trajectory.motion;
      motion.t_ns.push_back(std::llround(1e9 * t_s));
      motion.p_world_tip_m.emplace_back(s_m, 0.0, state.height_m);
      motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
      motion.v_world_tip_mps.emplace_back(speed_mps, 0.0, state.climb_mps);
      motion.a_world_tip_mps2.emplace_back(0.0, 0.0, state.accel_mps2 + accel_noise_mps2 * random.normal());
      motion.force_N.push_back(i % 10 == 0 ? state.force_N : kNan);
      r.base.path.p_world_m.emplace_back(s_m, 0.0, 0.0);
      r.base.path.n_world.push_back(Eigen::Vector3d::UnitZ());
      r.base.path.s_m.push_back(s_m);
      r.base.contact.push_back(1);
      r.base.speed_mps.push_back(speed_mps);
    }
    const auto points = static_cast<int>(length_m / r.profile.spacing_m);
    for (int i = 0; i <= points; ++i) {
      const double s_m = r.profile.spacing_m * i, h_m = at(s_m / speed_mps).height_m + kHeightNoise_m * random.normal();
      r.profile.s_m.push_back(s_m);
      r.profile.height_m.push_back(h_m);
      r.profile.texture_m.push_back(h_m);
      r.profile.speed_mps.push_back(speed_mps);
    }
    // Up to half of the 40 points a millimetre.
    r.noise.frequency_cycles_per_mm = {0.0, 20.0};
    r.noise.added_psd_m2_mm.assign(2, kHeightNoise_m * kHeightNoise_m / 20.0);
    r.spectrum.frequency_cycles_per_mm = {0.0, 20.0};
    r.spectrum.density_m2_mm.assign(2, 1e-12);
    return out;
  }

  // The relief itself, as a rendered surface with the true spring.
  RenderedRelief rendered(double factor = 1.0) const {
    RenderedRelief out;
    out.name = "relief";
    out.contact = {stiffness, 0.0};
    out.stiffness_known = out.friction_known = true;
    const auto points = static_cast<int>(length_m / out.spacing_m);
    for (int i = 0; i <= points; ++i) out.height_m.push_back(factor * relief_m(out.spacing_m * i));
    return out;
  }
};

// A stroke over 40 waves of 0.25 to 2 cycles/mm.
inline LinearStroke rough_stroke() {
  LinearStroke out;
  out.add_waves(40, 0.25, 2.0, 20e-6, 7);
  return out;
}

// Sensors that pass all.
inline RealismConfig ideal_sensors() {
  RealismConfig out;
  out.probe.accel_bandwidth_Hz = out.probe.force_bandwidth_Hz = 0.0;
  return out;
}

}  // namespace asperity::realism_test
