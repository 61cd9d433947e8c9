#pragma once

namespace asperity {

// White Gaussian heights under the tip (Siira and Pai 1996; thesis §2.3 and §6.5, erratum 27):
//   σ(v, f) = sigma_m (v / reference_speed)^speed_exponent (f / reference_force)^force_exponent
//   H = clamp(σ z + offset_sigmas σ, 0, 2 offset_sigmas σ),  z normal with mean 0 and variance 1
//   normal force k H, tangential force rho k (H − offset_sigmas σ), k = stiffness.
// The original draws a new z every servo step (correlation_length_m = 0), so that its spectrum moves with the servo's
// rate. With a correlation length, z changes with the distance travelled: a new impulse every length, blended at
// constant variance between.
struct StochasticTexture {
  double sigma_m = 0.0;
  double correlation_length_m = 0.0;
  double tangential_ratio = 0.0;  // rho
  double offset_sigmas = 3.0;     // erratum 20; 0: heights of both signs
  double stiffness_N_per_m = 300.0;
  double mass_kg = 0.05;  // that the force moves, where a series is wanted as acceleration
  double reference_speed_mps = 0.05;
  double speed_exponent = 0.0;
  double reference_force_N = 1.0;
  double force_exponent = 0.0;
  double fade_speed_mps = 5e-3;  // below it the texture fades to nothing
};

}  // namespace asperity
