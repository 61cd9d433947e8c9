#pragma once

#include <vector>

#include "asperity/texture/hand_verdict.h"
#include "asperity/texture/texture.h"

namespace asperity {

struct CompareVibrationsConfig {
  double low_Hz = 20.0;
  double high_Hz = 1000.0;
  double least_part = 0.03;

  template <class V>
  void visit(V& v) {
    v.field("low_Hz", low_Hz, "the band that is compared, from", {1.0, 1e5});
    v.field("high_Hz", high_Hz, "and to; less where the rate is low", {1.0, 1e5});
    v.field("least_part", least_part, "of the RMS acceleration: a band below it in both is below the threshold",
            {0.0, 1.0});
  }
};

// A vibration in pieces of one length each, m/s² at one rate, and the same of its noise.
struct ComparedVibration {
  std::vector<std::vector<double>> pieces_mps2;
  std::vector<std::vector<double>> noise_mps2;  // taken off; empty: none is known
  double rate_Hz = 0.0;
  // Of a vibration without noise pieces: the most that its noise can be, RMS in any band. 0: it has none, as what is
  // rendered; infinite: not known.
  double most_noise_mps2 = 0.0;
};

using VibrationVerdict = HandVerdict;

struct VibrationBand {
  double low_Hz = 0.0, high_Hz = 0.0;
  double a_mps2 = 0.0, b_mps2 = 0.0;  // RMS, noise taken off where it is known
  double percent = 0.0;               // 100 (b − a) / a; infinite if only a is zero
  double least_percent = 0.0;         // its size if the noise that is not known is the one that makes it least
  double most_percent = 0.0;          // and most; infinite if a may be zero
  double sigma_percent = 0.0;         // standard deviation that the pieces' number leaves
  double jnd_percent = 0.0;           // noticeable from here on
  bool is_compared = true;            // false: too weak in both to matter
  VibrationVerdict verdict = VibrationVerdict::kSame;
};

struct VibrationComparison {
  double low_Hz = 0.0, high_Hz = 0.0;  // the band that was compared
  double a_mps2 = 0.0, b_mps2 = 0.0;   // RMS in it
  std::vector<VibrationBand> bands;    // octaves
  // Noticeable if any compared band is; the same if all are.
  VibrationVerdict verdict = VibrationVerdict::kUndetermined;
};

// What a hand would notice between two vibrations, by octaves of frequency from the means of the pieces' periodograms
// (Hann), against just_noticeable_percent (compare_textures.h). A band is noticeable, or the same, only if that holds
// two standard deviations to either side, and for every noise that a side may have, else it is undetermined. The power
// of a band has the relative standard deviation √(2/n), n the number of independent bins in all pieces (half of them,
// by the window) times the noise's share. Throws Error for a vibration without pieces, pieces of unequal length or
// fewer than 16 samples, and a band without width.
VibrationComparison compare_vibrations(const ComparedVibration& a, const ComparedVibration& b,
                                       const CompareVibrationsConfig& config = {});

// The vibration of a tool over a texture at speed and force, a piece for each pair, by synthesize_stroke: of height
// fields each piece begins where the one before ended. Same texture and values, same samples.
ComparedVibration vibration_of(const Texture& texture, const std::vector<double>& speed_mps,
                               const std::vector<double>& force_N, double rate_Hz, double piece_s);

}  // namespace asperity
