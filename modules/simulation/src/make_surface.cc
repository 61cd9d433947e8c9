#include "asperity/simulation/make_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "load_surface.h"
#include "streams.h"

namespace asperity {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

class Sine final : public Surface {
 public:
  Sine(double amplitude_m, double pitch_m) : amplitude_m_(amplitude_m), turn_per_m_(kTurn / pitch_m) {}
  double height_m(double along_m, double) const override { return amplitude_m_ * std::sin(turn_per_m_ * along_m); }

 private:
  double amplitude_m_, turn_per_m_;
};

// Funnel-shaped holes on a square lattice.
class Protoboard final : public Surface {
 public:
  explicit Protoboard(const SimulatedSurfaceConfig& c)
      : pitch_m_(c.pitch_m),
        depth_m_(c.hole_depth_m),
        floor_radius_m_(0.5 * c.hole_diameter_m),
        face_radius_m_(0.5 * c.hole_opening_diameter_m) {
    if (face_radius_m_ < floor_radius_m_) {
      throw Error(fmt::format(
          "simulation.surface.hole_opening_diameter_m: {} is less than simulation.surface.hole_diameter_m {}",
          c.hole_opening_diameter_m, c.hole_diameter_m));
    }
  }
  double height_m(double along_m, double across_m) const override {
    const double radius_m = std::hypot(std::remainder(along_m, pitch_m_), std::remainder(across_m, pitch_m_));
    if (radius_m >= face_radius_m_) return 0.0;
    if (radius_m <= floor_radius_m_) return -depth_m_;
    return -depth_m_ * (face_radius_m_ - radius_m) / (face_radius_m_ - floor_radius_m_);
  }

 private:
  double pitch_m_, depth_m_, floor_radius_m_, face_radius_m_;
};

class CableTie final : public Surface {
 public:
  explicit CableTie(const SimulatedSurfaceConfig& c)
      : pitch_m_(c.pitch_m), height_m_(c.tooth_height_m), rise_(c.tooth_rise) {}
  double height_m(double along_m, double) const override {
    const double periods = along_m / pitch_m_;
    const double u = periods - std::floor(periods);
    return -height_m_ * (u < rise_ ? 1.0 - u / rise_ : (u - rise_) / (1.0 - rise_));
  }

 private:
  double pitch_m_, height_m_, rise_;
};

// A sum of plane waves of equal amplitude in random directions: Gaussian by the central limit, isotropic,
// without a period.
class RandomRelief final : public Surface {
 public:
  RandomRelief(const SimulatedSurfaceConfig& c, std::uint64_t seed) : amplitude_m_(c.rq_m * std::sqrt(2.0 / kWaves)) {
    if (!(c.low_cycles_per_mm < c.high_cycles_per_mm)) {
      throw Error(
          fmt::format("simulation.surface.low_cycles_per_mm: {} is not below simulation.surface.high_cycles_per_mm {}",
                      c.low_cycles_per_mm, c.high_cycles_per_mm));
    }
    Random random(seed, stream(Stream::kSurface));
    waves_.reserve(kWaves);
    for (int i = 0; i < kWaves; ++i) {
      // The inverse of the cumulative density of k^-slope on the band, one draw from each equal part.
      const double share = (i + random.uniform()) / kWaves;
      const double p = 1.0 - c.slope;
      const double ratio = c.high_cycles_per_mm / c.low_cycles_per_mm;
      const double k_per_mm = std::abs(p) < 1e-9
                                  ? c.low_cycles_per_mm * std::pow(ratio, share)
                                  : c.low_cycles_per_mm * std::pow(1.0 + share * (std::pow(ratio, p) - 1.0), 1.0 / p);
      const double direction = random.uniform(0.0, kTurn);
      const double k_per_m = kTurn * 1e3 * k_per_mm;
      waves_.push_back({k_per_m * std::cos(direction), k_per_m * std::sin(direction), random.uniform(0.0, kTurn)});
    }
  }
  double height_m(double along_m, double across_m) const override {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += std::cos(w.along_per_m * along_m + w.across_per_m * across_m + w.phase);
    return amplitude_m_ * sum;
  }

 private:
  static constexpr int kWaves = 300;
  struct Wave {
    double along_per_m, across_per_m, phase;
  };
  double amplitude_m_;
  std::vector<Wave> waves_;
};

}  // namespace

std::unique_ptr<Surface> make_surface(const SimulatedSurfaceConfig& config, std::uint64_t seed, Problems* problems) {
  switch (config.kind) {
    case SurfaceKind::kSine:
      return std::make_unique<Sine>(config.amplitude_m, config.pitch_m);
    case SurfaceKind::kProtoboard:
      return std::make_unique<Protoboard>(config);
    case SurfaceKind::kCableTie:
      return std::make_unique<CableTie>(config);
    case SurfaceKind::kSandpaper:
    case SurfaceKind::kClayPot:
      return std::make_unique<RandomRelief>(config, seed);
    case SurfaceKind::kFile:
      return load_surface(config, problems);
  }
  throw Error("simulation.surface.kind: unknown");
}

}  // namespace asperity
