#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "asperity/profile/profile_pass.h"

namespace asperity {

inline constexpr std::size_t kPassSegment_points = 512;  // of the densities and the test

// Heights without gaps from the first to the last that is known, by straight lines over the gaps.
struct PassSignal {
  double spacing_mm = 0.025;
  std::size_t first = 0;          // index in the pass
  std::vector<double> height_m;   // gaps bridged
  std::vector<char> known;        // one a height
  std::vector<double> frequency;  // cycles/mm, of the densities
  std::vector<double> density;    // one-sided, of surface and noise
  std::vector<double> noise;      // of the noise alone, at least a share of the density
  bool states_noise = false;

  std::size_t size() const { return height_m.size(); }
};

// Throws Error if the pass has fewer than 64 heights.
PassSignal pass_signal(const ProfilePass& pass);

// The same travelled the other way.
PassSignal reversed(PassSignal signal);

// Heights at places in units of the spacing, by cubics through four points; 0 outside.
double height_at(std::span<const double> height_m, double place);
std::vector<double> heights_at(std::span<const double> height_m, std::span<const double> places);

std::size_t power_of_two(std::size_t at_least);

}  // namespace asperity
