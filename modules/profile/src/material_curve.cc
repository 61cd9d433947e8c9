#include "material_curve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "asperity/base/radix_sort.h"

namespace asperity {

MaterialCurve::MaterialCurve(std::span<const double> heights) {
  falling_.reserve(heights.size());
  std::copy_if(heights.begin(), heights.end(), std::back_inserter(falling_), [](double z) { return !std::isnan(z); });
  sort_falling(falling_);
  const double n = static_cast<double>(falling_.size());
  for (const double z : falling_) mean_ += z / n;
  sum_.reserve(falling_.size() + 1);
  sum_.push_back(0.0);
  for (const double z : falling_) sum_.push_back(sum_.back() + (z - mean_));
}

double MaterialCurve::level(double ratio) const {
  const double n = static_cast<double>(falling_.size());
  const double at = std::clamp(ratio * n - 0.5, 0.0, n - 1.0);
  const auto below = std::min(static_cast<std::size_t>(at), falling_.size() - 2);
  return std::lerp(falling_[below], falling_[below + 1], at - static_cast<double>(below));
}

double MaterialCurve::ratio_above(double level) const {
  const auto [first, last] = std::equal_range(falling_.begin(), falling_.end(), level, std::greater<>{});
  return 0.5 * static_cast<double>((first - falling_.begin()) + (last - falling_.begin())) /
         static_cast<double>(falling_.size());
}

double MaterialCurve::integral(double ratio) const {
  const double n = static_cast<double>(falling_.size());
  const double at = std::clamp(ratio, 0.0, 1.0) * n;
  const auto whole = std::min(static_cast<std::size_t>(at), falling_.size() - 1);
  const double part = at - static_cast<double>(whole);
  return mean_ * at / n + (sum_[whole] + part * (falling_[whole] - mean_)) / n;
}

double MaterialCurve::material_volume(double ratio) const {
  return std::max(0.0, integral(ratio) - ratio * level(ratio));
}

double MaterialCurve::void_volume(double ratio) const {
  return std::max(0.0, (1.0 - ratio) * level(ratio) - (mean_ - integral(ratio)));
}

MaterialCore MaterialCurve::core() const {
  constexpr double kPart = 0.4;
  const std::size_t n = falling_.size();
  const auto reach =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(kPart * static_cast<double>(n))), 1, n - 1);
  // What rounding makes of equal falls is no smaller fall.
  const double rounding = 1e-12 * (falling_.front() - falling_.back());
  std::size_t best = 0;
  for (std::size_t i = 1; i + reach < n; ++i) {
    if (falling_[i] - falling_[i + reach] < falling_[best] - falling_[best + reach] - rounding) best = i;
  }
  // The least-squares line; positions from the middle of its samples, which are evenly spaced.
  const double count = static_cast<double>(reach + 1), middle = 0.5 * static_cast<double>(reach);
  double sum = 0.0, moment = 0.0;
  for (std::size_t j = 0; j <= reach; ++j) {
    sum += falling_[best + j] - mean_;
    moment += (static_cast<double>(j) - middle) * (falling_[best + j] - mean_);
  }
  const double slope = moment / (count * (count * count - 1.0) / 12.0);  // a sample; never positive
  const double centre = static_cast<double>(best) + middle + 0.5;        // in samples from ratio 0
  const double upper = mean_ + sum / count - slope * centre;
  const double lower = upper + slope * static_cast<double>(n);

  MaterialCore out;
  out.k = upper - lower;
  out.ratio1 = ratio_above(upper + rounding);
  out.ratio2 = ratio_above(lower - rounding);
  const double above = integral(out.ratio1) - out.ratio1 * upper;
  const double below = (1.0 - out.ratio2) * lower - (mean_ - integral(out.ratio2));
  out.pk = out.ratio1 > 0.0 ? std::max(0.0, 2.0 * above / out.ratio1) : 0.0;
  out.vk = out.ratio2 < 1.0 ? std::max(0.0, 2.0 * below / (1.0 - out.ratio2)) : 0.0;
  return out;
}

}  // namespace asperity
