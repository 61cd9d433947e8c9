#pragma once

namespace asperity {

// Of a two-sided exact binomial test of the share of trials against one half: the question of a study by pairs, whether
// one of two textures is chosen more often than by chance.
struct PowerConfig {
  double share = 0.75;  // expected share of the trials in which the one is chosen
  double alpha = 0.05;  // largest probability of a difference where there is none
  double power = 0.8;   // least probability of finding the expected difference
};

// The probability that the test of `trials` trials finds a difference at the level `alpha`, if the share is `share`.
// Throws Error for a share or level outside of 0 to 1, and for less than one or more than kMostPlannedTrials trials.
double power_of_trials(int trials, double share, double alpha);

inline constexpr int kMostPlannedTrials = 20'000;

// The least number of trials from which on the power is never below that of the config: the power of the exact test
// rises and falls from one number to the next. Throws Error if more than kMostPlannedTrials / 2 are needed, and for
// values that make no test.
int trials_for_power(const PowerConfig& config);

}  // namespace asperity
