#include "ticks.h"

#include <fmt/format.h>

#include <cmath>

namespace asperity {

std::vector<Tick> linear_ticks(double low, double high, int most) {
  const double rough = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power < rough) continue;
    step = factor * power;
    break;
  }
  std::vector<Tick> out;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  for (double k = first; k <= last; k += 1.0)
    out.push_back({k * step + 0.0, fmt::format("{:.6g}", k * step + 0.0)});  // no -0
  return out;
}

std::vector<Tick> decade_ticks(double low, double high, int most) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  if (last <= first) return linear_ticks(low, high, most);
  const int every = (last - first) / most + 1;
  std::vector<Tick> out;
  for (int k = first; k <= last; ++k)
    out.push_back({std::pow(10.0, k), (k - first) % every == 0 ? fmt::format("{:g}", std::pow(10.0, k)) : ""});
  return out;
}

}  // namespace asperity
