#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "asperity/study/staircase.h"
#include "asperity/study/study.h"
#include "asperity/study/tile_touch.h"
#include "asperity/study/trial.h"

namespace asperity {

// An answer to a trial.
struct StudyAnswer {
  Trial trial;
  int value = 0;                           // 0: left, 1: right; or the rating
  bool correct = false, reversal = false;  // of a staircase
  double response_s = 0.0;
  double since_begin_s = 0.0;
  std::array<TileTouch, 2> touches;  // of the left and the right texture; of a log of version 1 zero
};

// Which trial is next, from the study, the participant and the answers so far. Pure: no clock, no file.
class StudySession {
 public:
  // Throws Error as check_plan does.
  StudySession(Study study, std::string participant, int run);

  const Study& study() const { return study_; }
  const std::string& participant() const { return participant_; }
  int run() const { return run_; }

  // The trial to be answered; nothing: all are.
  const std::optional<Trial>& trial() const { return trial_; }
  const std::vector<StudyAnswer>& answers() const { return answers_; }
  const std::vector<StaircaseTrack>& tracks() const { return tracks_; }
  // Of the tracks of a staircase: the stimulus of each.
  int stimulus_of(std::size_t track) const { return static_cast<int>(track) % static_cast<int>(study_.stimuli.size()); }
  // How many trials there are; nothing: a staircase, which knows only at its end.
  std::optional<int> planned() const;

  // Throws Error for a value that is not an answer to this method, and if no trial is open.
  const StudyAnswer& give(int value, double response_s, double since_begin_s,
                          const std::array<TileTouch, 2>& touches = {});

  // The last answer can be withdrawn once, until the next one is given.
  bool can_take_back() const { return may_take_back_; }
  void take_back();

 private:
  void go_on();

  Study study_;
  std::string participant_;
  int run_;
  std::vector<Trial> planned_;
  std::vector<StaircaseTrack> tracks_;
  std::vector<std::vector<bool>> sides_;
  std::vector<StudyAnswer> answers_;
  std::optional<Trial> trial_;
  bool may_take_back_ = false;
};

}  // namespace asperity
