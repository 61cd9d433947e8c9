#include "open_questions.h"

namespace asperity {

void OpenQuestions::ask(Clock::time_point now) noexcept {
  if (count_ == kMost) {
    oldest_ = (oldest_ + 1) % kMost;
    --count_;
    needed_ = kRun;
  }
  questions_[(oldest_ + count_) % kMost] = {now, count_ == 0};
  ++count_;
}

bool OpenQuestions::answer(Clock::time_point now) noexcept {
  if (count_ == 0) return false;
  const Question question = questions_[oldest_];
  oldest_ = (oldest_ + 1) % kMost;
  --count_;
  last_age_ = now - question.asked_at;
  if (!question.alone || last_age_ > late_after_) {
    needed_ = kRun;
    return false;
  }
  if (needed_ > 0) --needed_;
  if (needed_ == 0) given_up_ = 0;
  return needed_ == 0;
}

void OpenQuestions::give_up() noexcept {
  if (count_ == 0 || given_up_ == kMostGivenUp) return;
  ++given_up_;
  needed_ = kRun;
  count_ = 0;
}

}  // namespace asperity
