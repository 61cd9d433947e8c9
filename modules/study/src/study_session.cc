#include "asperity/study/study_session.h"

#include <utility>

#include "asperity/base/error.h"
#include "asperity/study/plan_trials.h"

namespace asperity {

StudySession::StudySession(Study study, std::string participant, int run)
    : study_(std::move(study)), participant_(std::move(participant)), run_(run) {
  check_plan(study_);
  if (study_.method == StudyMethod::kStaircase) {
    const std::size_t tracks = study_.stimuli.size() * static_cast<std::size_t>(study_.repetitions);
    for (std::size_t k = 0; k < tracks; ++k) {
      tracks_.emplace_back(study_.staircase);
      sides_.push_back(plan_sides(study_, participant_, run_, static_cast<int>(k)));
    }
  } else {
    planned_ = plan_trials(study_, participant_, run_);
  }
  go_on();
}

std::optional<int> StudySession::planned() const {
  if (study_.method == StudyMethod::kStaircase) return std::nullopt;
  return static_cast<int>(planned_.size());
}

void StudySession::go_on() {
  trial_.reset();
  if (study_.method != StudyMethod::kStaircase) {
    if (answers_.size() < planned_.size()) trial_ = planned_[answers_.size()];
    return;
  }
  std::vector<int> open;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (!tracks_[k].done()) open.push_back(static_cast<int>(k));
  }
  if (open.empty()) return;
  Trial trial;
  trial.number = static_cast<int>(answers_.size()) + 1;
  const auto track = static_cast<std::size_t>(choose_track(study_, participant_, run_, trial.number, open));
  trial.track = static_cast<int>(track) + 1;
  trial.repetition = static_cast<int>(track / study_.stimuli.size()) + 1;
  trial.left = trial.right = stimulus_of(track);
  trial.level = tracks_[track].level();
  trial.comparison_right = sides_[track].at(tracks_[track].levels().size());
  trial_ = trial;
}

const StudyAnswer& StudySession::give(int value, double response_s, double since_begin_s,
                                      const std::array<TileTouch, 2>& touches) {
  if (!trial_) throw Error("all trials are answered");
  const bool rating = study_.method == StudyMethod::kRating;
  if (value < (rating ? kLowestRating : 0) || value > (rating ? kHighestRating : 1)) {
    throw Error(std::to_string(value) + " is not an answer to this trial");
  }
  StudyAnswer answer;
  answer.trial = *trial_;
  answer.value = value;
  answer.response_s = response_s;
  answer.since_begin_s = since_begin_s;
  answer.touches = touches;
  if (trial_->track > 0) {
    answer.correct = (value == 1) == trial_->comparison_right;
    answer.reversal = tracks_[static_cast<std::size_t>(trial_->track - 1)].push(answer.correct);
  }
  answers_.push_back(answer);
  may_take_back_ = true;
  go_on();
  return answers_.back();
}

void StudySession::take_back() {
  if (!may_take_back_) throw Error("no answer can be withdrawn");
  answers_.pop_back();
  may_take_back_ = false;
  // A track goes the same way again with the answers that are left.
  for (StaircaseTrack& track : tracks_) track = StaircaseTrack(study_.staircase);
  for (const StudyAnswer& answer : answers_) {
    if (answer.trial.track > 0) tracks_[static_cast<std::size_t>(answer.trial.track - 1)].push(answer.correct);
  }
  go_on();
}

}  // namespace asperity
