#pragma once

#include <array>
#include <string>
#include <vector>

namespace asperity {

// The vibration of a tool stroking at one speed and force: white noise e of variance `variance` through
//   x_n = gain (e_n + Σ b_i e_{n−i}) − Σ a_i x_{n−i},
// a and b given by their line spectral frequencies (autoregressive_filter.h).
struct AutoregressiveModel {
  double speed_mps = 0.0;
  double force_N = 0.0;
  std::vector<double> ar_lsf_rad;
  std::vector<double> ma_lsf_rad;  // empty: b = 0
  double gain = 1.0;
  double variance = 0.0;  // of e, (m/s²)²

  // Follow from the rest, see prepare_autoregressive(): the variance of e through 1/A, and the standard deviation of x.
  double pole_variance_m2_per_s4 = 0.0;
  double sigma_mps2 = 0.0;
};

// Vibrations as a function of speed and force (Romano and Kuchenbecker 2012; Culbertson, Unwin and Kuchenbecker 2014):
// models at points of the speed-force plane, between which line spectral frequencies, gain and variance are mixed by
// the barycentric weights of a triangulation.
struct AutoregressiveTexture {
  double rate_Hz = 1000.0;        // of the models
  double mass_kg = 0.05;          // effective mass of tool and hand: acceleration to force (HaTT: 0.05)
  double tangential_ratio = 0.0;  // tangential part of the force over its normal part, before the offset
  double offset_sigmas = 3.0;     // erratum 20; 0: forces of both signs
  double fade_speed_mps = 5e-3;   // below it the texture fades to nothing
  double fade_force_N = 0.05;     // likewise
  double max_speed_mps = 0.0;     // distances in the plane are measured in units of these; 0: the models' largest
  double max_force_N = 0.0;
  std::vector<AutoregressiveModel> models;    // all of one order
  std::vector<std::array<int, 3>> triangles;  // of indices of models; empty: Delaunay's
  std::vector<std::array<int, 2>> edges;      // the border, and what belongs to no triangle; follows from the rest
};

inline constexpr int kMaxSeriesModels = 1024;
inline constexpr int kMaxSeriesTriangles = 2 * kMaxSeriesModels;

// Checks everything an evaluator relies on and fills in what follows from the rest: the triangulation if there is
// none, triangles wound one way, edges, sigma_mps2. Throws Error naming `name` and the value for an order or
// count out of range, frequencies that do not rise within 0 and π by at least 1e-7 rad, and numbers that are not
// finite or of the wrong sign.
void prepare_autoregressive(AutoregressiveTexture& texture, const std::string& name);

}  // namespace asperity
