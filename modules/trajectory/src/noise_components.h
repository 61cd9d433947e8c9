#pragma once

#include <array>
#include <cstddef>

namespace asperity::inertial_smoother {

// The variance components of the model (docs/trajectory-noise.md has them one by one): the covariance of everything
// that is random is a sum of known matrices, each times a factor that is learnt from the recording.
enum Component : std::size_t {
  kAccelOwn,     // the sensor's own noise, white
  kAccelMotion,  // grows with the moving part of the specific force
  kAccelJitter,  // of the samples' stamps: grows with the specific force's slope
  kAccelFast,    // along the fastest part of the specific force, as large as that: what folds about the sampling rate
  kGyroOwn,
  kGyroMotion,  // grows with the angular rate
  kAccelWalk,   // of the accelerometer's bias
  kRateWalk,    // of the gyroscope's bias; without one of the angular rate itself
  kPositionX,   // the tracker's white part, world axes
  kPositionY,
  kPositionZ,
  kRotationX,
  kRotationY,
  kRotationZ,
  kPoseTime,     // jitter of the poses' stamps: grows with velocity and angular rate
  kSlow,         // the tracker's slow part, of positions
  kSlowTurn,     // and of rotations
  kAccelMatrix,  // priors of constants: scale and alignment of the accelerometer,
  kGyroMatrix,   // of the gyroscope,
  kGravity,      // and gravity's stated direction and size
  kComponents
};

using Factors = std::array<double, kComponents>;

inline constexpr Factors kUnitFactors = [] {
  Factors out{};
  for (double& factor : out) factor = 1.0;
  return out;
}();

// What the smoothed noise shows of each component, and what it would show on average if the factors were right: the
// two sides of the likelihood's derivative (Koopman and Shephard, Biometrika 79, 1992), whose sums over the recording
// are θᵢ yᵀV⁻¹VᵢV⁻¹y and θᵢ tr V⁻¹Vᵢ for a recording y of covariance V = Σ θᵢ Vᵢ.
struct NoiseScore {
  Factors seen{};
  Factors expected{};

  void add(Component component, double seen_now, double expected_now) {
    seen[component] += seen_now;
    expected[component] += expected_now;
  }
};

}  // namespace asperity::inertial_smoother
