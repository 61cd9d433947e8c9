// Which answers are current. The oracle knows which question each answer is really to.
#include "../src/open_questions.h"

#include <algorithm>
#include <deque>
#include <random>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using Clock = OpenQuestions::Clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr milliseconds kLate{10};
constexpr Clock::time_point kStart{};

TEST(OpenQuestions, AnAnswerInTimeIsCurrent) {
  OpenQuestions questions(kLate);
  EXPECT_EQ(questions.open(), 0U);
  questions.ask(kStart);
  EXPECT_EQ(questions.open(), 1U);
  EXPECT_TRUE(questions.answer(kStart + kLate));
  EXPECT_EQ(questions.last_age(), kLate);
  EXPECT_TRUE(questions.trusted());
}

TEST(OpenQuestions, NobodyAskedForIt) {
  OpenQuestions questions(kLate);
  EXPECT_FALSE(questions.answer(kStart));
  questions.ask(kStart);
  EXPECT_TRUE(questions.answer(kStart));
  EXPECT_FALSE(questions.answer(kStart));
  EXPECT_EQ(questions.open(), 0U);
}

TEST(OpenQuestions, ALateAnswerCostsARunOfGoodOnes) {
  OpenQuestions questions(kLate);
  questions.ask(kStart);
  EXPECT_FALSE(questions.answer(kStart + kLate + microseconds(1)));
  for (int i = 1; i <= OpenQuestions::kRun; ++i) {
    const auto now = kStart + milliseconds(20 * i);
    questions.ask(now);
    EXPECT_EQ(questions.answer(now + milliseconds(1)), i == OpenQuestions::kRun) << i;
  }
}

TEST(OpenQuestions, AnAnswerIsCountedForTheOldestQuestion) {
  OpenQuestions questions(kLate);
  questions.ask(kStart);
  questions.ask(kStart + milliseconds(20));
  // It comes a millisecond after the second question, and is the first's.
  EXPECT_FALSE(questions.answer(kStart + milliseconds(21)));
  EXPECT_EQ(questions.last_age(), milliseconds(21));
  // The second was asked while another was open: soon, but no proof.
  EXPECT_FALSE(questions.answer(kStart + milliseconds(22)));
  EXPECT_EQ(questions.last_age(), milliseconds(2));
}

TEST(OpenQuestions, GivesUpNoMoreThanSoOften) {
  OpenQuestions questions(kLate);
  for (int i = 0; i < OpenQuestions::kMostGivenUp; ++i) {
    questions.ask(kStart);
    questions.give_up();
    EXPECT_EQ(questions.open(), 0U);
  }
  questions.ask(kStart);
  questions.give_up();
  EXPECT_EQ(questions.open(), 1U);
}

TEST(OpenQuestions, KeepsAnyNumber) {
  OpenQuestions questions(kLate);
  for (std::size_t i = 0; i < 3 * OpenQuestions::kMost; ++i) questions.ask(kStart + milliseconds(i));
  EXPECT_EQ(questions.open(), OpenQuestions::kMost);
  EXPECT_FALSE(questions.answer(kStart + milliseconds(100)));
  EXPECT_EQ(questions.last_age(), milliseconds(100 - 2 * OpenQuestions::kMost));
}

// A device at the end of a line, asked as the drivers ask: one question at a time, a second one after 20 ms of silence,
// and what was not answered within 0.2 s is given up.
struct Line {
  struct Answer {
    Clock::time_point due, stated;  // it states the position of that time
  };

  explicit Line(unsigned seed) : random(seed) {}

  void ask() {
    questions.ask(now);
    second = questions.open() > 1;
    if (lost(random) < lost_share) return;
    auto comes = now + delay + microseconds(jitter_us > 0 ? std::uniform_int_distribution(0, jitter_us)(random) : 0);
    if (!answers.empty()) comes = std::max(comes, answers.back().due);  // in order
    answers.push_back({comes, now});
  }

  // Runs for `time`; the greatest true age of a position that was called current, and how many there were.
  void run(Clock::duration time) {
    for (const auto end = now + time; now < end; now += microseconds(100)) {
      while (!answers.empty() && answers.front().due <= now) {
        const Answer answer = answers.front();
        answers.pop_front();
        if (questions.open() == 0) continue;  // the drivers throw it away before they ask
        heard = now;
        if (!questions.answer(now)) continue;
        ++current;
        oldest = std::max(oldest, now - answer.stated);
      }
      if (now - heard > OpenQuestions::kGiveUpAfter) {
        questions.give_up();
      }
      if (questions.open() == 0 && now >= due) {
        ask();
        due = now + milliseconds(1);
        silent = now + milliseconds(20);
      } else if (questions.open() == 1 && !second && now >= silent && questions.trusted()) {
        ask();
      }
    }
  }

  OpenQuestions questions{kLate};
  std::mt19937 random;
  std::uniform_real_distribution<double> lost{0.0, 1.0};
  std::deque<Answer> answers;
  Clock::time_point now{}, due{}, heard{}, silent{};
  bool second = false;
  Clock::duration delay = milliseconds(1), oldest{};
  int jitter_us = 0, current = 0;
  double lost_share = 0.0;
};

TEST(OpenQuestions, NothingOldIsCurrentWhateverTheDelay) {
  for (int delay_ms = 1; delay_ms <= 600; delay_ms += delay_ms < 50 ? 1 : 13) {
    Line line(static_cast<unsigned>(delay_ms));
    line.run(milliseconds(100));
    EXPECT_GE(line.current, 45) << delay_ms;
    line.delay = milliseconds(delay_ms);
    line.run(milliseconds(2));  // what is under way still comes in time
    line.current = 0;
    line.run(std::chrono::seconds(5));
    EXPECT_EQ(line.current > 0, milliseconds(delay_ms) <= kLate) << delay_ms;
    EXPECT_LE(line.oldest, kLate + microseconds(100)) << delay_ms;
    // And it is believed again.
    line.delay = milliseconds(1);
    line.current = 0;
    line.run(std::chrono::seconds(2));
    if (delay_ms < 200) {
      EXPECT_GT(line.current, 500) << delay_ms;
    }
    EXPECT_LE(line.oldest, kLate + microseconds(100)) << delay_ms;
  }
}

TEST(OpenQuestions, NothingOldIsCurrentWhateverIsLost) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Line line(seed);
    line.delay = milliseconds(seed % 7);
    line.jitter_us = static_cast<int>(seed % 10) * 20000;
    line.lost_share = 0.002 * (seed % 4);
    line.run(std::chrono::seconds(20));
    EXPECT_LE(line.oldest, kLate + microseconds(100)) << seed;
  }
}

}  // namespace
}  // namespace asperity
