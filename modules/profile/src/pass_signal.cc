#include "pass_signal.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr std::size_t kLeast_points = 64;
// Of the density: two passes never agree better, for their tips did not take the same way.
constexpr double kLeastNoise = 0.01;

}  // namespace

PassSignal pass_signal(const ProfilePass& pass) {
  PassSignal out;
  out.spacing_mm = 1e3 * pass.spacing_m;
  std::size_t first = 0, last = pass.size(), known = 0;
  while (first < last && !std::isfinite(pass.texture_m[first])) ++first;
  while (last > first && !std::isfinite(pass.texture_m[last - 1])) --last;
  for (std::size_t i = first; i < last; ++i) {
    out.known.push_back(std::isfinite(pass.texture_m[i]) ? 1 : 0);
    known += out.known.back() != 0 ? 1U : 0U;
  }
  if (known < kLeast_points) {
    throw Error("pass '" + pass.name + "': " + std::to_string(known) + " heights, fewer than " +
                std::to_string(kLeast_points));
  }
  out.first = first;
  out.height_m = bridge_gaps(std::span<const double>(pass.texture_m).subspan(first, last - first));
  const PowerSpectrum spectrum = welch(out.height_m, 1.0 / out.spacing_mm, std::min(kPassSegment_points, out.size()));
  out.frequency = spectrum.frequency;
  out.density = spectrum.density;
  out.noise.resize(out.density.size());
  out.states_noise = !pass.noise_psd_m2_mm.empty();
  for (std::size_t i = 0; i < out.noise.size(); ++i) {
    const double stated = pass.noise_psd_m2_mm.empty()
                              ? 0.0
                              : spectrum_at(pass.frequency_cycles_per_mm, pass.noise_psd_m2_mm, out.frequency[i]);
    out.noise[i] = std::max(kLeastNoise * out.density[i], stated);
  }
  return out;
}

PassSignal reversed(PassSignal signal) {
  std::reverse(signal.height_m.begin(), signal.height_m.end());
  std::reverse(signal.known.begin(), signal.known.end());
  return signal;
}

double height_at(std::span<const double> height_m, double place) {
  const auto n = static_cast<std::ptrdiff_t>(height_m.size());
  if (!(place >= 0.0) || !(place <= static_cast<double>(n - 1))) return 0.0;
  const auto i = std::min(static_cast<std::ptrdiff_t>(place), n - 2);
  const double u = place - static_cast<double>(i);
  const auto at = [&](std::ptrdiff_t k) {
    return height_m[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, n - 1))];
  };
  // Lagrange's.
  return -u * (u - 1.0) * (u - 2.0) / 6.0 * at(i - 1) + (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0 * at(i) -
         (u + 1.0) * u * (u - 2.0) / 2.0 * at(i + 1) + (u + 1.0) * u * (u - 1.0) / 6.0 * at(i + 2);
}

std::vector<double> heights_at(std::span<const double> height_m, std::span<const double> places) {
  std::vector<double> out(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) out[i] = height_at(height_m, places[i]);
  return out;
}

std::size_t power_of_two(std::size_t at_least) {
  std::size_t n = 16;
  while (n < at_least) n *= 2;
  return n;
}

}  // namespace asperity
