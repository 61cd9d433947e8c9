#include "texture_id.h"

#include <bit>
#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

namespace asperity {
namespace {

// Words mixed one after another by the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) + 0x9e3779b97f4a7c15;
    value_ = (value_ ^ (value_ >> 30)) * 0xbf58476d1ce4e5b9;
    value_ = (value_ ^ (value_ >> 27)) * 0x94d049bb133111eb;
    value_ ^= value_ >> 31;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) {
      if constexpr (std::is_integral_v<Value>)
        add(static_cast<std::uint64_t>(value));
      else
        add(value);
    }
  }
  template <class... Numbers>
  requires(sizeof...(Numbers) > 1) void add(const Numbers&... numbers) { (add(numbers), ...); }

  void add(const Fourier1d& f) { add(f.length_mm, f.mean_m, f.a_m, f.b_m); }
  void add(const SplineGrid& g) {
    add(static_cast<std::uint64_t>(g.columns), static_cast<std::uint64_t>(g.rows), g.spacing_x_m, g.spacing_y_m,
        g.origin_x_m, g.origin_y_m, static_cast<std::uint64_t>(g.border), g.coefficient_m);
  }
  void add(const Fourier2d& f) { add(static_cast<std::uint64_t>(f.kind), f.x, f.y, f.scale_per_m, f.offset_m, f.grid); }
  void add(const HeightMap& m) {
    add(static_cast<std::uint64_t>(m.columns), static_cast<std::uint64_t>(m.rows), m.mm_per_px_x, m.mm_per_px_y,
        m.low_m, m.high_m, static_cast<std::uint64_t>(m.bits), static_cast<std::uint64_t>(m.border), m.level);
  }
  void add(const ArealTexture& t) { add(t.surface); }
  void add(const StochasticTexture& t) {
    add(t.sigma_m, t.grain_m, t.tangential_ratio, t.lift_sigma, t.stiffness_N_per_m, t.reference_speed_mps,
        t.speed_exponent, t.reference_force_N, t.force_exponent, t.fade_speed_mps);
  }
  void add(const AutoregressiveTexture& t) {
    add(t.rate_Hz, t.mass_kg, t.tangential_ratio, t.fade_speed_mps, t.fade_force_N, t.max_speed_mps, t.max_force_N);
    for (const AutoregressiveModel& m : t.models)
      add(m.speed_mps, m.force_N, m.gain, m.variance, m.ar_lsf_rad, m.ma_lsf_rad);
    for (const auto& triangle : t.triangles) {
      for (const int corner : triangle) add(static_cast<std::uint64_t>(corner));
    }
  }
  void add(const DecayingSinusoids& t) {
    add(t.a_per_s, t.b_per_kg, t.decay_per_s, t.omega_rad_per_s, t.mass_kg, t.tangential_ratio, t.pitch_m);
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace

std::uint64_t texture_id(const RenderTexture& texture) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(texture.texture.model.index()), static_cast<std::uint64_t>(texture.model),
           texture.seed, texture.lift_m);
  std::visit([&](const auto& model) { hash.add(model); }, texture.texture.model);
  return hash.value() == 0 ? 1 : hash.value();
}

}  // namespace asperity
