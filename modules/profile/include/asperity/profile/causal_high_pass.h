#pragma once

#include "asperity/signal/butterworth.h"

namespace asperity {

// The second-order Butterworth high-pass of evenly spaced heights, forward only: -3 dB at the cut-off as the batch's
// (extract_texture.h), but with a phase: it leads, by 16 degrees at five times the cut-off. Runs begin at rest on their
// first height. Thread-safe: no.
class CausalHighPass {
 public:
  // A cut-off of 0 takes off each run's first height alone. Throws Error for a spacing or cut-off out of range.
  CausalHighPass(double spacing_m, double cutoff_cycles_per_mm, double bridge_m);

  // The next point's texture, nan for a nan height. Holes up to bridge_m are bridged by a straight line.
  double push(double height_m);
  // A new run begins with the next height.
  void cut();

  // By how much the envelope of a narrow band about `cycles_per_mm` is behind; 0 without a cut-off.
  double group_delay_m(double cycles_per_mm) const;

 private:
  double filter(double height_m);

  double spacing_m_;
  double bridge_;  // points
  bool filters_ = false;
  Biquad section_{};
  bool running_ = false;
  double first_m_ = 0.0;
  double last_m_ = 0.0;
  double hole_ = 0.0;  // points since the last height
  double z1_ = 0.0, z2_ = 0.0;
};

}  // namespace asperity
