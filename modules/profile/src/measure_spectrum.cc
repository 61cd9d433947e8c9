#include "asperity/profile/measure_spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

PowerSpectrum measure_spectrum(std::span<const double> height_m, double spacing_m, const SpectrumConfig& config) {
  if (!(spacing_m > 0.0)) throw Error("spectrum: spacing " + number_text(spacing_m) + " m");
  std::vector<std::span<const double>> runs;
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < height_m.size();) {
    std::size_t end = begin;
    while (end < height_m.size() && std::isfinite(height_m[end])) ++end;
    if (end > begin) runs.push_back(height_m.subspan(begin, end - begin));
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  constexpr std::size_t kFewest = 16;
  PowerSpectrum out;
  if (longest < kFewest) return out;
  const double wanted = std::min(config.segment_m / spacing_m, static_cast<double>(longest));
  const std::size_t segment = std::max(kFewest, static_cast<std::size_t>(std::lround(wanted)));
  for (const std::span<const double> run : runs) {
    if (run.size() < segment) continue;
    const PowerSpectrum one = welch(run, 1e-3 / spacing_m, segment);
    const auto weight = static_cast<double>(one.segments);
    if (out.segments == 0) {
      out.frequency = one.frequency;
      out.density.assign(one.density.size(), 0.0);
    }
    for (std::size_t k = 0; k < out.density.size(); ++k) out.density[k] += weight * one.density[k];
    out.segments += one.segments;
  }
  for (double& density : out.density) density /= static_cast<double>(out.segments);
  return out;
}

}  // namespace asperity
