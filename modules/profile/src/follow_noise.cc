#include "follow_noise.h"

#include <algorithm>

#include "draw_noise.h"

namespace asperity {

std::size_t noise_draws(std::size_t count) {
  constexpr std::size_t kMost = 24, kFewest = 6;
  constexpr std::size_t kMostPoints = 200'000;  // in all draws
  return std::max(kFewest, std::min(kMost, kMostPoints / std::max<std::size_t>(1, count)));
}

std::vector<double> draw_shaped_noise(const TextureNoise& noise, const std::vector<double>& psd_m2_mm,
                                      const std::vector<double>& sigma_m, std::size_t count, double spacing_m,
                                      Random& random) {
  std::vector<double> out = draw_noise(noise.frequency_cycles_per_mm, psd_m2_mm, count, 1e3 * spacing_m, random);
  double power_m2 = 0.0;
  for (std::size_t i = 1; i < psd_m2_mm.size(); ++i) {
    power_m2 += 0.5 * (psd_m2_mm[i] + psd_m2_mm[i - 1]) *
                (noise.frequency_cycles_per_mm[i] - noise.frequency_cycles_per_mm[i - 1]);
  }
  if (sigma_m.size() != count || !(power_m2 > 0.0)) return out;
  for (std::size_t i = 0; i < count; ++i) out[i] *= sigma_m[i] / std::sqrt(power_m2);
  return out;
}

}  // namespace asperity
