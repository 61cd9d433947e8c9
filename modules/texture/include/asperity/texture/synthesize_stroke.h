#pragma once

#include <cstdint>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/texture/texture.h"

namespace asperity {

struct StrokeConfig {
  double speed_mps = 0.05;
  double force_N = 1.0;
  double rate_Hz = 8000.0;
  double duration_s = 2.0;
  double start_m = 0.0;
  double y_m = 0.0;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v.field("speed_mps", speed_mps, "of the stroke", {0.0, 10.0});
    v.field("force_N", force_N, "with which it is pressed on", {0.0, 100.0});
    v.field("rate_Hz", rate_Hz, "samples a second", {1.0, 1e6});
    v.field("duration_s", duration_s, "of the stroke", {0.0, 3600.0});
    v.field("start_m", start_m, "where along the scan path it begins, for height fields", {-1e3, 1e3});
    v.field("y_m", y_m, "across the scan path, for height fields", {-1e3, 1e3});
    v.field("seed", seed, "of the models that have noise", {0, 9e15});
  }
};

// The acceleration, m/s² at rate_Hz, of a tool that strokes the texture at a constant speed.
// Height fields: along the surface normal, v² ∂²h/∂x² averaged over one sample's travel (a difference of slopes, so
// that what is finer than a sample is averaged rather than folded). Autoregressive textures and decaying sinusoids:
// theirs; the former converted to rate_Hz (convert_rate); a decaying sinusoid without a pitch is one tap at the start.
// Stochastic textures: their force, the offset taken off, over their mass. Same texture and config, same samples.
// Throws Error for a config out of range or more than 2^28 samples; Cancelled.
std::vector<double> synthesize_stroke(const Texture& texture, const StrokeConfig& config = {},
                                      const Observer& observer = {});

}  // namespace asperity
