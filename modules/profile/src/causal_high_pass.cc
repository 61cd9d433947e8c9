#include "asperity/profile/causal_high_pass.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

CausalHighPass::CausalHighPass(double spacing_m, double cutoff_cycles_per_mm, double bridge_m)
    : spacing_m_(spacing_m), bridge_(bridge_m / spacing_m), filters_(cutoff_cycles_per_mm > 0.0) {
  if (!(spacing_m > 0.0) || !(cutoff_cycles_per_mm >= 0.0) || !(bridge_m >= 0.0)) {
    throw Error("texture: spacing " + number_text(spacing_m) + " m, cut-off " + number_text(cutoff_cycles_per_mm) +
                " cycles/mm, bridge " + number_text(bridge_m) + " m");
  }
  if (filters_) section_ = butterworth_highpass(2, cutoff_cycles_per_mm, 1e-3 / spacing_m).front();
}

void CausalHighPass::cut() { running_ = false; }

double CausalHighPass::filter(double height_m) {
  const double x = height_m - first_m_;
  last_m_ = height_m;
  if (!filters_) return x;
  const double y = section_.b0 * x + z1_;
  z1_ = section_.b1 * x - section_.a1 * y + z2_;
  z2_ = section_.b2 * x - section_.a2 * y;
  return y;
}

double CausalHighPass::push(double height_m) {
  if (!std::isfinite(height_m)) {
    hole_ += 1.0;
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (!running_ || hole_ > bridge_) {
    running_ = true;
    first_m_ = height_m;
    z1_ = z2_ = 0.0;
  } else {
    const double from_m = last_m_;
    const double count = hole_ + 1.0;
    for (double k = 1.0; k < count; k += 1.0) filter(from_m + (height_m - from_m) * k / count);
  }
  hole_ = 0.0;
  return filter(height_m);
}

double CausalHighPass::group_delay_m(double cycles_per_mm) const {
  if (!filters_) return 0.0;
  const double rate = 1e-3 / spacing_m_;
  const double step = 1e-4 * cycles_per_mm;
  const std::span<const Biquad> sections(&section_, 1);
  const auto gain_a = frequency_response(sections, cycles_per_mm - step, rate);
  const auto gain_b = frequency_response(sections, cycles_per_mm + step, rate);
  return -std::arg(gain_b / gain_a) / (2.0 * std::numbers::pi * 2.0 * step) * 1e-3;
}

}  // namespace asperity
