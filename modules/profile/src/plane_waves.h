#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/texture_noise.h"
#include "bent_path.h"

namespace asperity {

// Heights h_k at points u_k of a bent path, evenly along its chord, and their plane waves: the ordinate at the wave
// vector g (cycles/m, along the chord and to its left) is P(g) = 2Δ/n |Σ h_k exp(−2πi g·u_k)|², Δ the step along the
// chord. Where the path is straight that is its periodogram at the frequency along it.
class PlaneWaves {
 public:
  // Heights in m, nan in gaps; they are averaged to four points for the shortest wave. The noise may be `most_noise`
  // times as much.
  PlaneWaves(const BentPath& path, std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
             double most_noise, double shortest_m);

  // How far waves stand out of what is beside them. Each wave's ordinate is of what it explains beyond those before it,
  // the strongest first: on a path of little bend two waves may be nearly the same. Its density is fitted to the
  // neighbours in the rest when all are subtracted by least squares. q is the exponent of exp(−q), the probability of
  // such an ordinate of a random surface, as LineSearch has it.
  struct Standing {
    std::vector<double> rarity;  // q by the neighbours ± 2 to 16 independent frequencies along the chord, and the noise
    double narrow_rarity = 0.0;  // sum of q by the nearest alone, as LineSearch asks for a narrow peak
    std::vector<double> ratio;   // of the ordinate to the density
    double information = 0.0;    // of a scale of all wave vectors, Σ 2 ratio · phase variance, 1/(2π)² of Fisher's
    double power_share = 0.0;    // of the heights' mean square, all waves together
  };
  Standing standing_of(std::span<const Eigen::Vector2d> waves_per_m) const;

  double power_at(const Eigen::Vector2d& wave_per_m) const { return power_at(height_m_, wave_per_m); }

  // Variance of the phase of a wave over the path, cycles².
  double phase_variance(const Eigen::Vector2d& wave_per_m) const;

  // The noise's density at a wave, at its most: the mean over the path at the frequency at which each part of it meets
  // the wave.
  double noise_at(const Eigen::Vector2d& wave_per_m) const;

  // Points, of which gaps have a height of 0.
  std::size_t size() const { return height_m_.size(); }
  double step_m() const { return step_m_; }
  double points() const { return points_; }  // that are no gap
  const std::vector<double>& y_m() const { return y_m_; }
  const std::vector<double>& heights_m() const { return height_m_; }
  double mean_square_m2() const { return mean_square_m2_; }

 private:
  double power_at(std::span<const double> height_m, const Eigen::Vector2d& wave_per_m) const;
  struct Beside {
    double density, variance;
  };
  Beside density_beside(const Eigen::Vector2d& wave_per_m, int nearest, int farthest, bool sides,
                        std::span<const double> rest_m) const;

  std::vector<double> height_m_, y_m_;
  std::vector<char> present_;
  std::vector<Eigen::Vector2d> direction_;  // of travel, of parts of the path
  double step_m_ = 0.0, points_ = 0.0, mean_square_m2_ = 0.0, most_noise_ = 1.0;
  const TextureNoise& noise_;
};

}  // namespace asperity
