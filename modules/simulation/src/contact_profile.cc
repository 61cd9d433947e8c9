#include "asperity/simulation/contact_profile.h"

#include <algorithm>
#include <cmath>

#include "tip_dilation.h"

namespace asperity {
namespace {

constexpr int kLevels = 7;

}  // namespace

ContactProfile::ContactProfile(const Surface& surface, const ScanBase& base, const ScanPath& path,
                               const SimulatedContactConfig& contact, double greatest_force_N)
    : tip_radius_m_(contact.tip_radius_m) {
  const auto count = static_cast<std::size_t>(std::ceil((path.length_m() + 2.0 * kMargin_m) / kSpacing_m)) + 1;
  std::vector<double> relief_m;
  relief_m.reserve(count);
  Ground ground;
  for (std::size_t i = 0; i < count; ++i) {
    const ScanPoint point = path.at(kSpacing_m * static_cast<double>(i) - kMargin_m);
    const Ground here = base.ground(point.a_m, point.v_m);
    if (here.found) ground = here;
    relief_m.push_back(surface.height_m(point.a_m, point.v_m) + ground.height_m);
  }
  levels_.push_back(dilate_by_tip(relief_m, kSpacing_m, contact.tip_radius_m));

  const double greatest_radius_m = std::sqrt(contact.tip_radius_m * greatest_force_N / contact.stiffness_N_per_m);
  if (greatest_radius_m < kSpacing_m) return;
  radius_step_m_ = std::max(kSpacing_m, greatest_radius_m / (kLevels - 1));
  for (double radius_m = radius_step_m_; radius_m < greatest_radius_m + 0.5 * radius_step_m_;
       radius_m += radius_step_m_) {
    levels_.push_back(smooth_by_contact(levels_.front(), kSpacing_m, radius_m));
  }
}

ContactProfile::Value ContactProfile::at(double s_m, double indentation_m) const {
  const double last = static_cast<double>(levels_.front().size() - 1);
  const double place = std::clamp((s_m + kMargin_m) / kSpacing_m, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(place), levels_.front().size() - 2);
  const double u = place - static_cast<double>(i);
  const auto on_level = [&](std::size_t level) {
    const double* h = levels_[level].data() + i;
    const double rise = h[1] - h[0];
    return Value{h[0] + u * rise, rise / kSpacing_m};
  };
  if (levels_.size() == 1) return on_level(0);
  const double radius_m = std::sqrt(tip_radius_m_ * std::max(0.0, indentation_m));
  const double level = std::min(radius_m / radius_step_m_, static_cast<double>(levels_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(level), levels_.size() - 2);
  const double w = level - static_cast<double>(k);
  const Value sharp = on_level(k);
  const Value smooth = on_level(k + 1);
  return {sharp.height_m + w * (smooth.height_m - sharp.height_m), sharp.slope + w * (smooth.slope - sharp.slope)};
}

}  // namespace asperity
