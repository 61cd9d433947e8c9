#pragma once

namespace asperity {

// What a tool rings with after a tap or an edge (Okamura, Dennerlein and Howe 1998; Okamura, Hage and Cutkosky 2001;
// thesis §2.3):
//   Q(t) = (a v + b f) e^(−B t) sin(ω t)
// as acceleration, v the speed of the impact and f the force. With a pitch, a stroke meets an edge every pitch of
// distance, at the speed and force of that moment.
struct DecayingSinusoids {
  double a_per_s = 0.0;        // (m/s²) a (m/s)
  double b_per_kg = 0.0;       // (m/s²) a newton
  double decay_per_s = 100.0;  // B
  double omega_rad_per_s = 1000.0;
  double mass_kg = 0.05;          // acceleration to force
  double tangential_ratio = 0.0;  // tangential part of the force over its normal part
  double pitch_m = 0.0;           // distance between edges; 0: taps only
};

}  // namespace asperity
