#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/study/study.h"
#include "asperity/study/trial.h"

namespace asperity {

inline constexpr std::size_t kMostTrials = 5000;

// Throws Error in words for a study that cannot be begun: too few stimuli for its method or more than kMostTrials
// trials, a staircase that makes no sense.
void check_plan(const Study& study);

// The stream of Random for what is drawn for one run of one participant: the FNV-1a hash of all three.
std::uint64_t study_stream(std::string_view participant, int run, std::string_view purpose);

// All trials of a study by pairs or of ratings, in order. Balanced: a repetition has each pair in both orders once, or
// each stimulus once.
std::vector<Trial> plan_trials(const Study& study, std::string_view participant, int run);

// Whether the changed texture of a staircase's track lies at the right, trial by trial of the track: two of four.
std::vector<bool> plan_sides(const Study& study, std::string_view participant, int run, int track);

// Which of the `open` tracks the trial of this number is of.
int choose_track(const Study& study, std::string_view participant, int run, int trial, const std::vector<int>& open);

}  // namespace asperity
