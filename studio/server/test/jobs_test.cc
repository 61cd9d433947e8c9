#include "asperity/studio/jobs.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "fake_hub.h"
#include "inbox.h"

namespace asperity::studio {
namespace {

using namespace std::chrono_literals;

// The studio's thread is the test's.
class JobsTest : public ::testing::Test {
 protected:
  FakeHub hub_;
  Inbox inbox_;
  Jobs jobs_{hub_, [this](Inbox::Work work) { inbox_.post(std::move(work)); }};

  Request request(std::uint64_t id) { return Request(hub_, 1, Call{id, "test", Json::object()}); }

  // Does what is posted until `id` is answered.
  FakeHub::Answer wait_for(std::uint64_t id) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!hub_.answered(id) && std::chrono::steady_clock::now() < end) {
      for (const auto& work : inbox_.wait(end)) work();
    }
    return hub_.answer_to(id);
  }
};

TEST_F(JobsTest, AnswersWithWhatTheWorkGives) {
  answer_by_job(jobs_, request(1), "adds", "", [](const Observer&) { return Json(42); });
  EXPECT_EQ(wait_for(1).result, 42);
  EXPECT_EQ(hub_.events("job").back()["state"], "done");
}

TEST_F(JobsTest, AnErrorIsARefusal) {
  answer_by_job(jobs_, request(1), "fails", "", [](const Observer&) -> Json { throw Advice("no", "try again"); });
  EXPECT_EQ(wait_for(1).error, "no");
  EXPECT_EQ(wait_for(1).hint, "try again");
  EXPECT_EQ(hub_.events("job").back()["state"], "failed");
}

TEST_F(JobsTest, TheNewestOfASlotIsWorkedOut) {
  std::atomic<bool> started{false};
  answer_by_job(jobs_, request(1), "first", "slot", [&](const Observer& observer) -> Json {
    started = true;
    for (;;) observer.update("turning", 0.5);
  });
  while (!started) std::this_thread::yield();
  answer_by_job(jobs_, request(2), "second", "slot", [](const Observer&) { return Json(2); });
  answer_by_job(jobs_, request(3), "third", "slot", [](const Observer&) { return Json(3); });
  EXPECT_EQ(wait_for(3).result, 3);
  EXPECT_EQ(wait_for(1).error, "cancelled");
  EXPECT_EQ(wait_for(2).error, "cancelled");
}

TEST_F(JobsTest, OthersOfNoSlotOrAnotherGoOn) {
  for (std::uint64_t id = 1; id < 6; ++id) {
    answer_by_job(jobs_, request(id), "job", id % 2 == 0 ? "slot" + std::to_string(id) : "",
                  [id](const Observer&) { return Json(id); });
  }
  for (std::uint64_t id = 1; id < 6; ++id) EXPECT_EQ(wait_for(id).result, id);
}

TEST_F(JobsTest, IsCancelledByItsNumber) {
  Calls calls;
  jobs_.bind(calls);
  std::atomic<bool> started{false};
  const std::uint64_t job = jobs_.start(
      "turns", "",
      [&](const Observer& observer) {
        started = true;
        for (;;) observer.update("", 0.5);
      },
      [this](std::exception_ptr error) {
        EXPECT_TRUE(error);
        request(7).done();
      });
  while (!started) std::this_thread::yield();
  Json args;
  args["job"] = job;
  calls.dispatch(Request(hub_, 1, Call{8, "job.cancel", args}));
  wait_for(7);
  EXPECT_EQ(hub_.events("job").back()["state"], "cancelled");
}

TEST_F(JobsTest, NoMoreThanSoManyWait) {
  std::atomic<bool> go_on{false};
  const auto work = [&](const Observer&) {
    while (!go_on) std::this_thread::yield();
    return Json(1);
  };
  std::uint64_t id = 0;
  EXPECT_THROW(
      {
        for (; id < 2 * Jobs::kMostWaiting; ++id) answer_by_job(jobs_, request(id), "", "", work);
      },
      Advice);
  EXPECT_GE(id, Jobs::kMostWaiting);
  EXPECT_LE(id, Jobs::kMostWaiting + 2);  // one runs, and one may just have been taken
  go_on = true;
  EXPECT_EQ(wait_for(id - 1).result, 1);
  answer_by_job(jobs_, request(id), "", "", work);
  EXPECT_EQ(wait_for(id).result, 1);
}

// Ends what runs and drops what waits, but not what stores.
TEST_F(JobsTest, TheEndWaitsForWhatStores) {
  std::atomic<bool> started{false};
  const auto until_cancelled = [&](const Observer& observer) {
    started = true;
    for (;;) observer.update("turning", 0.5);
  };
  std::vector<std::string> done;  // by the lane's thread, which has ended before it is read
  jobs_.start_in("lane", "", "", until_cancelled, nullptr);
  while (!started) std::this_thread::yield();
  jobs_.start_storing(
      "lane", "", "the first is lost", [&](const Observer&) { done.emplace_back("first"); }, nullptr);
  jobs_.start_in(
      "lane", "", "", [&](const Observer&) { done.emplace_back("not stored"); }, nullptr);
  const auto stores = [&](const Observer& observer) {
    observer.update("storing", 0.5);  // is not cancelled
    done.emplace_back("second");
  };
  jobs_.start_storing("lane", "", "the second is lost", stores, nullptr);
  EXPECT_THAT(jobs_.close(), testing::IsEmpty());
  EXPECT_THAT(done, testing::ElementsAre("first", "second"));
  EXPECT_THAT(jobs_.close(), testing::IsEmpty());
}

// Nobody is there to whom its `done` could state it.
TEST_F(JobsTest, TheEndStatesWhatCouldNotBeStored) {
  const auto fails = [](const Observer&) { throw Error("x.csv: cannot be written: the disk is full"); };
  bool is_told = false;
  jobs_.start_storing("lane", "", "the first is lost", fails,
                      [&](std::exception_ptr error) { is_told = error != nullptr; });
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!is_told && std::chrono::steady_clock::now() < end) {
    for (const auto& work : inbox_.wait(end)) work();
  }
  ASSERT_TRUE(is_told);
  jobs_.start_storing("lane", "", "the second is lost", fails, [](std::exception_ptr) { FAIL() << "after the end"; });
  EXPECT_THAT(jobs_.close(), testing::ElementsAre("the second is lost: x.csv: cannot be written: the disk is full"));
}

}  // namespace
}  // namespace asperity::studio
