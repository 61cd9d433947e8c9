#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/study/bradley_terry.h"
#include "asperity/study/interval.h"
#include "asperity/study/study_session.h"

namespace asperity {

// How often something was, of so many trials.
struct ShareOfTrials {
  double count = 0.0;
  double trials = 0.0;
  Interval interval;  // of its probability, 95 % (Wilson); 0 to 1 without trials

  std::optional<double> share() const { return trials > 0.0 ? std::optional(count / trials) : std::nullopt; }
};

struct PairOfTextures {
  int first = 0, second = 0;  // indices of stimuli
  ShareOfTrials wins;         // of the first
};

struct PairsResults {
  Eigen::MatrixXd wins;  // (i, j): how often i was preferred to j
  std::vector<PairOfTextures> pairs;
  BradleyTerry fit;
};

struct TrackResults {
  int stimulus = 0;
  std::size_t repetition = 1;
  StaircaseTrack track;
  StaircaseThreshold threshold;
  std::optional<double> error_ln;  // standard error of ln(threshold); staircase_error.h
};

struct StaircaseResults {
  double target = 0.0;  // probability of a right answer at the threshold
  std::vector<TrackResults> tracks;
};

struct TextureRatings {
  std::array<int, kHighestRating - kLowestRating + 1> counts{};
  std::vector<int> values;            // in the order of the trials
  std::optional<MeanOfRatings> mean;  // nothing without ratings; of one, interval and deviation are not determined
};

// What a session gives, as far as it is (docs/studio-study.md). One of the last three, by the study's method.
struct StudyResults {
  Study study;
  std::string participant;
  int run = 1;
  std::size_t answers = 0;
  bool whole = false;  // all trials are answered
  std::optional<double> median_response_s;
  ShareOfTrials left;  // answers "left"; of ratings it is empty

  std::optional<PairsResults> pairs;
  std::optional<StaircaseResults> staircase;
  std::vector<TextureRatings> ratings;  // by stimulus
};

StudyResults study_results(const StudySession& session);

// (i, j): how often stimulus i was preferred to j, in a study by pairs.
Eigen::MatrixXd count_wins(const StudySession& session);

// What the study's method is for and the answers do not determine: one sentence each, empty if there is nothing.
std::vector<std::string> undetermined(const StudyResults& results);

}  // namespace asperity
