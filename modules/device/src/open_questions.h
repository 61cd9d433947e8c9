#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace asperity {

// The questions to a device that answers each of them once and in order, and never says which one it answers. It keeps
// when each open question was asked: the n-th answer is to the n-th question, so its age has an upper limit. Without
// this a device that answers late gives old positions that look new, for there is always one to arrive just now.
//
// A position is current if its question was asked while no other was open and was answered within `late_after`. After
// any other answer, and after questions that were given up, kRun such answers in a row are needed before the next is
// current. An answer to a question that was given up may still come, and each answer is then counted for a question
// after its own. With n such answers under way the ages of n + 1 answers in a row sum to the true delay, so one of them
// is late if the delay is above (n + 1) late_after. No more than kRun - 1 are under way, for questions are given up
// after 0.2 s of silence, two at first, then one, and kMostGivenUp times at most until an answer is current again.
class OpenQuestions {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kRun = 8;
  static constexpr int kMostGivenUp = 5;
  static constexpr std::size_t kMost = 16;
  static constexpr std::chrono::milliseconds kGiveUpAfter{200};

  explicit OpenQuestions(Clock::duration late_after) : late_after_(late_after) {}

  // A question was sent. Of more than kMost the oldest is given up.
  void ask(Clock::time_point now) noexcept;

  // An answer came: whether its position is current. An answer that nobody asked for is not.
  bool answer(Clock::time_point now) noexcept;

  // Nothing came for kGiveUpAfter: no answer to what was asked is waited for. Does nothing after kMostGivenUp times.
  void give_up() noexcept;

  std::size_t open() const noexcept { return count_; }
  bool trusted() const noexcept { return needed_ == 0; }           // the last answer was current
  Clock::duration last_age() const noexcept { return last_age_; }  // of the last answer

 private:
  struct Question {
    Clock::time_point asked_at;
    bool alone = false;
  };

  Clock::duration late_after_;
  std::array<Question, kMost> questions_{};  // a ring
  std::size_t oldest_ = 0, count_ = 0;
  int needed_ = 1;  // answers in time until one is current
  int given_up_ = 0;
  Clock::duration last_age_{};
};

}  // namespace asperity
