#pragma once

#include <map>
#include <string>
#include <vector>

#include "asperity/texture/hand_verdict.h"

namespace asperity {

struct CompareTexturesConfig {
  double speed_mps = 0.05;
  double low_cycles_per_mm = 0.15;
  double high_cycles_per_mm = 12.8;
  double segment_mm = 10.0;
  double least_part = 0.03;
  double least_rms_um = 0.007;

  template <class V>
  void visit(V& v) {
    v.field("speed_mps", speed_mps, "of the hand: makes spatial frequencies vibrations", {1e-4, 10.0});
    v.field("low_cycles_per_mm", low_cycles_per_mm, "the band that is compared, from", {1e-6, 1e6});
    v.field("high_cycles_per_mm", high_cycles_per_mm, "and to; less where the heights lie too far apart", {1e-6, 1e6});
    v.field("segment_mm", segment_mm, "of the spectrum's averaging", {1e-6, 1e6});
    v.field("least_part", least_part, "of the RMS height: a frequency band below it in both is below the threshold",
            {0.0, 1.0});
    v.field("least_rms_um", least_rms_um,
            "RMS height below the threshold of detection: bands and surfaces below it in both are the same",
            {0.0, 1e3});
  }
};

// What is compared: heights along one or more lines of a surface.
struct ComparedSurface {
  std::vector<std::vector<double>> lines_m;
  double spacing_m = 0.0;
  std::map<std::string, double> roughness;  // Rq_m, RSm_m, … of the band-limited lines
  // The same of pieces of the lines, [line][piece]: their scatter is the values' uncertainty.
  std::map<std::string, std::vector<std::vector<double>>> roughness_of_pieces;
};

// One quantity of both, and what a hand would notice of the difference.
struct Difference {
  double a = 0.0;
  double b = 0.0;
  double percent = 0.0;              // 100 (b − a) / a; infinite if only a is zero, nan where either is undefined
  double uncertainty_percent = 0.0;  // half of the 95 % interval, by the scatter along the lines; nan: not known
  double jnd_percent = 0.0;          // noticeable from here on; nan: no threshold is known
  HandVerdict verdict = HandVerdict::kUndetermined;
};

struct BandDifference {
  double low_cycles_per_mm = 0.0;
  double high_cycles_per_mm = 0.0;
  Difference rms_m;
  bool is_compared = true;  // false: too weak in both, beside the other bands, to matter
  bool is_felt = true;      // false: in both below what any hand feels
  bool is_resolved = true;  // false: a line is shorter than two of its longest waves

  bool counts() const { return is_compared && is_felt && is_resolved; }
};

struct TextureComparison {
  double low_cycles_per_mm = 0.0;  // the band that was compared
  double high_cycles_per_mm = 0.0;
  std::vector<BandDifference> bands;            // octaves
  std::map<std::string, Difference> roughness;  // of the names that both have; Rq_m and RSm_m with a verdict
  Difference frequency_per_mm;                  // mean spatial frequency, weighted by power; for information
  // Rsk or Rku differ by more than twice their uncertainty: hills and pits have other shapes, of which no threshold is
  // known. Not part of the verdict.
  bool other_shape = false;
  // Noticeable if any band that counts, Rq_m or RSm_m is; the same if all are, or if no hand feels either.
  HandVerdict verdict = HandVerdict::kUndetermined;
};

// The just-noticeable difference of a vibration in percent (thesis §2.1): 3 up to 250 Hz [19], 18 from 300 Hz
// (Pongrac [18]), between them on a straight line.
double just_noticeable_percent(double frequency_Hz);

// Heights as they are compared: gaps bridged by straight lines, then a zero-phase band-pass to the band (its
// upper end at most 0.45 of the sampling rate). Throws Error for an empty line, a spacing that is not positive,
// or a band without width.
std::vector<double> band_limited_heights(const std::vector<double>& height_m, double spacing_m,
                                         const CompareTexturesConfig& config = {});

// What a hand would notice between two surfaces whose lines went through band_limited_heights. Spectra are
// Welch's (1967), averaged over the lines, integrated over octaves of spatial frequency f; an octave about f is
// felt at f · speed, where the difference of its RMS heights is held against just_noticeable_percent. The
// seed's figures are of frequency; RSm and the mean frequency are compared by them as they stand, amplitudes by
// the same for want of others. Rq and RSm are held against the threshold at the mean frequency of a; of the other
// roughness values no threshold is known. A difference is noticeable, or the same, only if that holds within its
// interval of 95 %, which is that of the scatter of Welch's segments and of the pieces; else it is undetermined.
// Throws Error for a surface without lines, lines of fewer than 16 heights, or a spacing that is not positive.
TextureComparison compare_textures(const ComparedSurface& a, const ComparedSurface& b,
                                   const CompareTexturesConfig& config = {});

}  // namespace asperity
