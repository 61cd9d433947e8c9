#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "estimate_lean.h"
#include "path_evidence.h"

namespace asperity {

// Sums over a band's Fourier coefficients: of |a_n|², |a_b|² and Re(a_n a_b*), n along the base's normal and b across
// travel.
struct BandPower {
  double normal = 0.0, across = 0.0, both = 0.0;

  // Of the acceleration along n cos φ + b sin φ, along b cos φ − n sin φ, and of both.
  double along_normal(double phi) const;
  double across_normal(double phi) const;
  double both_at(double phi) const;
  BandPower turned(double phi) const { return {along_normal(phi), across_normal(phi), both_at(phi)}; }
  BandPower times(double factor) const;
  BandPower& operator+=(const BandPower& other);
};

struct LeanBand {
  BandPower measured;
  BandPower noise;     // what is expected of MotionNoise; 0: not known
  double count = 0.0;  // of independent coefficients
};

// A stretch of the motion: the sums of each bin, and how much the change of the lean goes with it.
struct LeanStretch {
  double change = 0.0;
  std::vector<LeanBand> bins;  // from the lowest frequency on
};

// The bins that are looked at, 4 to 60 Hz.
struct LeanBins {
  std::size_t first = 0, last = 0;
};

LeanBins lean_bins(double rate_Hz);

// Of overlapping windows of 256 cells in which the tip moves in contact. The accelerations are second differences of
// the tip's cells off the base, times the square of their step.
//
// The noise is white acceleration of the accelerometer, the same along n and b, and the rotation's error θ on the lever
// l from the accelerometer to the tip, (2πf)² θ × l, which is across the lever only. The gyroscope's noise is taken
// from the motion, for single readings that were lost or replaced are part of it: what the probe's rotation moves the
// tip by, its least third octave between a frequency and twice that, since a hand's rotation falls with frequency.
std::vector<LeanStretch> find_lean_stretches(const TipMotion& motion, std::span<const double> t_s,
                                             const PathEvidence& evidence, const BasePath& base, const LeanAxes& axes,
                                             const LeanBins& bins);

// The sums over third octaves and all stretches, each turned by the change of the lean there.
std::vector<LeanBand> find_lean_bands(const std::vector<LeanStretch>& stretches, const LeanBins& bins,
                                      double change_rad);

}  // namespace asperity
