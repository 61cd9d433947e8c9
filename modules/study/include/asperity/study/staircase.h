#pragma once

#include <optional>
#include <vector>

#include "asperity/base/config.h"

namespace asperity {

// A weighted, transformed up-down staircase (Levitt 1971; Kaernbach 1991) over a positive level, in steps of its
// logarithm.
struct StaircaseConfig {
  double start_level = 1.0;
  double lowest_level = 0.01;
  double highest_level = 4.0;
  int down = 2;
  double up_weight = 1.0;
  double step_factor = 2.0;
  int halvings = 2;
  int reversals = 10;
  int most_trials = 100;

  template <class V>
  void visit(V& v) {
    v.field("start_level", start_level, "level of the first trial", {1e-6, 1e3});
    v.field("lowest_level", lowest_level, "never below", {1e-6, 1e3});
    v.field("highest_level", highest_level, "never above", {1e-6, 1e3});
    v.field("down", down, "right answers in a row after which the level falls", {1, 5});
    v.field("up_weight", up_weight, "size of a step up over that of a step down", {0.1, 10.0});
    v.field("step_factor", step_factor, "a step down divides the level by this, at first", {1.001, 10.0});
    v.field("halvings", halvings,
            "first reversals, after each of which the step is halved; they count for nothing else", {0, 10});
    v.field("reversals", reversals, "after which the track ends", {2, 100});
    v.field("most_trials", most_trials, "after which the track ends in any case", {2, 1000});
  }
};

// Throws Error for a config out of range: levels out of order, or no reversal left after the halvings.
void check_staircase(const StaircaseConfig& config);

// One track of trials. The config is to be the same throughout.
class StaircaseTrack {
 public:
  explicit StaircaseTrack(const StaircaseConfig& config);

  double level() const { return level_; }
  bool done() const;

  // Takes the answer to a trial at level(). True if it is a reversal: a trial after which the level changes direction.
  bool push(bool correct);

  const std::vector<double>& levels() const { return levels_; }                   // of all trials
  const std::vector<bool>& correct() const { return correct_; }                   // of all trials
  const std::vector<std::size_t>& reversal_trials() const { return reversals_; }  // indices of levels()

 private:
  bool turn(int direction);

  StaircaseConfig config_;
  double level_;
  double step_;  // down, in ln(level)
  int correct_in_a_row_ = 0;
  int direction_ = 0;
  std::vector<double> levels_;
  std::vector<bool> correct_;
  std::vector<std::size_t> reversals_;
};

struct StaircaseThreshold {
  std::optional<double> level;  // none: too few reversals, or at_limit
  std::size_t pairs = 0;        // of reversals that were taken
  bool at_limit = false;        // one of them is at the lowest or the highest level
};

// The threshold of a track: the geometric mean of the last even number of the reversals after the halvings. At a limit
// the track was held rather than turned by the answers: there is none.
StaircaseThreshold staircase_threshold(const StaircaseTrack& track, const StaircaseConfig& config);

// The probability of a right answer at which the rule settles: (w / (1 + w))^(1/n).
double staircase_target(const StaircaseConfig& config);

}  // namespace asperity
