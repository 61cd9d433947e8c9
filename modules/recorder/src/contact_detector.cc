#include "asperity/recorder/contact_detector.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr double kFollow_s = 0.5;               // time constant with which the idle level follows a drift
constexpr std::int64_t kAboveWeighs = 4;        // a sample above against one below, when a touch ends
constexpr double kLeastVariance = 1.0 / 12.0;   // of a converter's rounding, counts²
constexpr std::int64_t kFewestIdleSamples = 8;  // for a noise worth the name

void check_thresholds(const char* low_name, double low, const char* high_name, double high) {
  if (low > high) {
    throw Error(std::string("contact.") + low_name + " (" + number_text(low) + ") is above contact." + high_name +
                " (" + number_text(high) + ")");
  }
}

}  // namespace

ContactDetector::ContactDetector(const TouchConfig& config, const std::optional<ForceCalibration>& force)
    : config_(config), force_(force) {
  check_thresholds("off_N", config.off_N, "on_N", config.on_N);
  check_thresholds("off_noise", config.off_noise, "on_noise", config.on_noise);
}

bool ContactDetector::ready() const { return force_.has_value() || idle_known_; }

ContactDetector::Level ContactDetector::level(std::int64_t t_ns, double counts) {
  const auto between = [](double value, double low, double high) {
    if (value > high) return Level::kHigh;
    return value < low ? Level::kLow : Level::kBetween;
  };
  if (force_) return between(force_->force_N(counts), config_.off_N, config_.on_N);
  if (!idle_known_) {
    learn_idle(t_ns, counts);
    return Level::kLow;
  }
  const Level out =
      between(std::abs(counts - idle_mean_), config_.off_noise * idle_noise_, config_.on_noise * idle_noise_);
  if (!touching_ && out == Level::kLow) learn_idle(t_ns, counts);
  return out;
}

void ContactDetector::learn_idle(std::int64_t t_ns, double counts) {
  const double off = counts - idle_mean_;
  if (idle_known_) {
    const double share = 1.0 - std::exp(-static_cast<double>(t_ns - last_ns_) * kNanosecond_s / kFollow_s);
    idle_mean_ += share * off;
    return;
  }
  ++idle_count_;
  idle_mean_ += off / static_cast<double>(idle_count_);
  idle_square_ += off * (counts - idle_mean_);
  if (t_ns - *first_ns_ < nanoseconds(config_.idle_s) || idle_count_ < kFewestIdleSamples) return;
  idle_known_ = true;
  idle_noise_ = std::sqrt(std::max(kLeastVariance, idle_square_ / static_cast<double>(idle_count_ - 1)));
}

std::optional<ContactChange> ContactDetector::push(std::int64_t t_ns, double force_counts) {
  if (!std::isfinite(force_counts) || (first_ns_ && t_ns <= last_ns_)) return std::nullopt;
  if (!first_ns_) {
    first_ns_ = t_ns;
    last_ns_ = t_ns;
  }
  const Level at = level(t_ns, force_counts);
  const std::int64_t step_ns = t_ns - last_ns_;
  last_ns_ = t_ns;
  if (touching_) {
    // Noise lifts single samples above the threshold long after the touch: they set the count back, not to zero.
    off_evidence_ns_ += at == Level::kLow ? step_ns : -kAboveWeighs * step_ns;
    if (off_evidence_ns_ <= 0) {
      off_evidence_ns_ = 0;
      last_above_ns_ = t_ns;
    }
    if (off_evidence_ns_ < nanoseconds(config_.off_hold_s) || at != Level::kLow) return std::nullopt;
    touching_ = false;
    above_since_ns_.reset();
    return ContactChange{false, last_above_ns_};
  }
  if (at != Level::kHigh) {
    above_since_ns_.reset();
    return std::nullopt;
  }
  if (!above_since_ns_) above_since_ns_ = t_ns;
  if (t_ns - *above_since_ns_ < nanoseconds(config_.on_hold_s)) return std::nullopt;
  touching_ = true;
  off_evidence_ns_ = 0;
  last_above_ns_ = t_ns;
  return ContactChange{true, *above_since_ns_};
}

}  // namespace asperity
