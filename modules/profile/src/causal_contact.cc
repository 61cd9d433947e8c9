#include "asperity/profile/causal_contact.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kMost = 20'000;  // readings in the window, changes in hand

std::int64_t nanoseconds(double s) { return std::llround(s * 1e9); }

}  // namespace

CausalContact::CausalContact(const ContactConfig& config) : config_(config) {
  if (config.release_N > config.touch_N) {
    throw Error("contact: release_N " + number_text(config.release_N) + " is above touch_N " +
                number_text(config.touch_N));
  }
}

// Later changes than this one are overtaken by it: margins of brief touches overlap.
void CausalContact::change(std::int64_t t_ns, bool touching) {
  while (!changes_.empty() && changes_.back().t_ns >= t_ns) changes_.pop_back();
  if (!changes_.empty() && changes_.back().touching == touching) return;
  changes_.push_back({t_ns, touching});
  if (changes_.size() > kMost) changes_.pop_front();
}

void CausalContact::push(std::int64_t t_ns, double force_N) {
  if (!std::isfinite(force_N) || (!window_.empty() && t_ns <= window_.back().t_ns)) return;
  window_.push_back({t_ns, force_N});
  while (t_ns - window_.front().t_ns > nanoseconds(config_.smoothing_s) || window_.size() > kMost) {
    window_.pop_front();
  }
  double sum_N = 0.0;
  for (const Reading& reading : window_) sum_N += reading.force_N;
  const double mean_N = sum_N / static_cast<double>(window_.size());
  const std::int64_t centre_ns = window_.front().t_ns + (t_ns - window_.front().t_ns) / 2;

  if (!measured_) {
    measured_ = true;
    touching_ = mean_N >= 0.5 * (config_.touch_N + config_.release_N);
    change(centre_ns, touching_);
    return;
  }
  const bool before = touching_;
  touching_ = touching_ ? mean_N >= config_.release_N : mean_N >= config_.touch_N;
  if (before && !touching_) {
    flight_possible_ = true;
    lifted_ns_ = centre_ns;
  } else if (!before && touching_) {
    if (!flight_possible_) change(centre_ns + nanoseconds(config_.margin_s), true);
    flight_possible_ = false;
  }
  if (flight_possible_ && centre_ns - lifted_ns_ > nanoseconds(config_.max_flight_s)) {
    flight_possible_ = false;
    change(lifted_ns_ - nanoseconds(config_.margin_s), false);
  }
}

bool CausalContact::touching_at(std::int64_t t_ns) const {
  if (!measured_) return true;
  const auto after = std::upper_bound(changes_.begin(), changes_.end(), t_ns,
                                      [](std::int64_t t, const Change& change) { return t < change.t_ns; });
  if (after == changes_.begin()) return !changes_.empty() && changes_.front().touching;
  return std::prev(after)->touching;
}

void CausalContact::forget_before(std::int64_t t_ns) {
  while (changes_.size() > 1 && changes_[1].t_ns <= t_ns) changes_.pop_front();
}

void CausalContact::reset() { *this = CausalContact(config_); }

}  // namespace asperity
