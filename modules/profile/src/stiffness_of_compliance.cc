#include "asperity/profile/stiffness_of_compliance.h"

#include <array>
#include <cmath>
#include <limits>

namespace asperity {
namespace {

struct ChartPoint {
  double stiffness_N_per_mm, low, median, high;  // k_c
};

// build/release/bin/compliance chart --seeds 6; the upper ends' running maximum.
constexpr std::array<ChartPoint, 11> kChart{{{1.0, 0.722, 0.880, 0.981},
                                             {1.5, 0.800, 0.902, 0.981},
                                             {2.0, 0.818, 0.910, 0.981},
                                             {3.0, 0.857, 0.916, 0.986},
                                             {5.0, 0.867, 0.933, 0.988},
                                             {7.0, 0.880, 0.942, 0.988},
                                             {10.0, 0.902, 0.952, 0.988},
                                             {15.0, 0.920, 0.963, 0.993},
                                             {20.0, 0.935, 0.972, 0.997},
                                             {50.0, 0.936, 0.981, 1.0},
                                             {200.0, 0.958, 0.989, 1.0}}};

// The stiffness at which a rising column has the value; `above` beyond its last.
double stiffness_at(double ChartPoint::*column, double k_c, double above) {
  if (k_c <= kChart.front().*column) return kChart.front().stiffness_N_per_mm;
  for (std::size_t i = 1; i < kChart.size(); ++i) {
    const ChartPoint &a = kChart[i - 1], &b = kChart[i];
    if (k_c > b.*column) continue;
    const double part = (k_c - a.*column) / (b.*column - a.*column);
    return a.stiffness_N_per_mm * std::pow(b.stiffness_N_per_mm / a.stiffness_N_per_mm, part);
  }
  return above;
}

}  // namespace

std::optional<ChartedStiffness> stiffness_of_compliance(const Compliance& compliance) {
  if (!compliance.determined) return std::nullopt;
  const double stiffest = kChart.back().stiffness_N_per_mm;
  return ChartedStiffness{stiffness_at(&ChartPoint::median, compliance.k_c, stiffest),
                          stiffness_at(&ChartPoint::high, compliance.k_c, stiffest),
                          stiffness_at(&ChartPoint::low, compliance.k_c, std::numeric_limits<double>::infinity())};
}

}  // namespace asperity
