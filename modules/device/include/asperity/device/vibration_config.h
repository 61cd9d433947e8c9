#pragma once

#include <cstdint>

namespace asperity {

// How forces become the samples of a sound.
struct VibrationConfig {
  double servo_rate_Hz = 1000.0;  // at which forces are pushed
  double audio_rate_Hz = 48000.0;
  double high_pass_Hz = 30.0;  // below, a hand is pushed rather than vibrated
  double full_scale_N = 1.0;   // at volume 1 this force is amplitude 1
  double volume = 0.5;
  double ceiling = 0.8;    // no sample is ever larger; from half of it on, levels are bent softly
  double fade_s = 0.008;   // in and out
  double buffer_s = 0.01;  // of forces waiting, in addition to one block: how late the servo may be
  template <class V>
  void visit(V& v) {
    v.field("servo_rate_Hz", servo_rate_Hz, "rate of the pushed forces, Hz", {100.0, 4000.0});
    v.field("audio_rate_Hz", audio_rate_Hz, "rate of the samples, Hz", {8000.0, 192000.0});
    v.field("high_pass_Hz", high_pass_Hz, "-3 dB point of the second-order high-pass, Hz", {1.0, 200.0});
    v.field("full_scale_N", full_scale_N, "force of amplitude 1 at volume 1, N", {0.001, 1000.0});
    v.field("volume", volume, "factor", {0.0, 1.0});
    v.field("ceiling", ceiling, "largest amplitude", {0.01, 1.0});
    v.field("fade_s", fade_s, "fading in and out, s", {0.001, 1.0});
    v.field("buffer_s", buffer_s, "forces kept waiting, s", {0.001, 0.5});
  }
};

}  // namespace asperity
