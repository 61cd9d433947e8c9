#include "asperity/study/staircase.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/text.h"
#include "asperity/study/study_error.h"

namespace asperity {

void check_staircase(const StaircaseConfig& config) {
  if (!(config.lowest_level <= config.start_level && config.start_level <= config.highest_level)) {
    throw StudyError(StudyFault::kStaircaseLevels,
                     "staircase: the start level " + number_text(config.start_level) + " is not between the lowest " +
                         number_text(config.lowest_level) + " and the highest " + number_text(config.highest_level));
  }
  if (config.reversals < config.halvings + 2) {
    throw StudyError(StudyFault::kStaircaseReversals, "staircase: " + std::to_string(config.reversals) +
                                                          " reversals leave no two after " +
                                                          std::to_string(config.halvings) + " halvings");
  }
}

StaircaseTrack::StaircaseTrack(const StaircaseConfig& config)
    : config_(config), level_(config.start_level), step_(std::log(config.step_factor)) {
  check_staircase(config);
}

bool StaircaseTrack::done() const {
  return static_cast<int>(reversals_.size()) >= config_.reversals ||
         static_cast<int>(levels_.size()) >= config_.most_trials;
}

bool StaircaseTrack::push(bool correct) {
  levels_.push_back(level_);
  correct_.push_back(correct);
  if (!correct) {
    correct_in_a_row_ = 0;
    return turn(1);
  }
  if (++correct_in_a_row_ < config_.down) return false;
  correct_in_a_row_ = 0;
  return turn(-1);
}

bool StaircaseTrack::turn(int direction) {
  const bool reversal = direction_ == -direction;
  direction_ = direction;
  if (reversal) {
    reversals_.push_back(levels_.size() - 1);
    if (static_cast<int>(reversals_.size()) <= config_.halvings) step_ *= 0.5;
  }
  const double change = direction > 0 ? config_.up_weight * step_ : -step_;
  level_ = std::clamp(level_ * std::exp(change), config_.lowest_level, config_.highest_level);
  return reversal;
}

StaircaseThreshold staircase_threshold(const StaircaseTrack& track, const StaircaseConfig& config) {
  StaircaseThreshold out;
  const std::vector<std::size_t>& at = track.reversal_trials();
  const auto halvings = static_cast<std::size_t>(config.halvings);
  if (at.size() < halvings + 2) return out;
  out.pairs = (at.size() - halvings) / 2;
  double sum_ln = 0.0;
  for (std::size_t k = at.size() - 2 * out.pairs; k < at.size(); ++k) {
    const double level = track.levels()[at[k]];
    out.at_limit = out.at_limit || level <= config.lowest_level || level >= config.highest_level;
    sum_ln += std::log(level);
  }
  if (!out.at_limit) out.level = std::exp(sum_ln / static_cast<double>(2 * out.pairs));
  return out;
}

double staircase_target(const StaircaseConfig& config) {
  return std::pow(config.up_weight / (1.0 + config.up_weight), 1.0 / config.down);
}

}  // namespace asperity
