#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

// Long work with progress and cancel, in lanes: the jobs of a lane run one after another on a thread of its own, those
// of different lanes side by side. The browsers see
//   event "job"
//   {"id","title","stage","fraction","state":"waiting"|"running"|"done"|"failed"|"cancelled","message","hint"}
// but for jobs without a title, and can call job.cancel {"job":id} and job.list. Its functions are for the studio's
// thread.
class Jobs {
 public:
  using Work = std::function<void(const Observer&)>;     // on the jobs' thread; may throw
  using Done = std::function<void(std::exception_ptr)>;  // on the studio's thread, once unless the studio ends; null:
                                                         // all went well
  using Post = std::function<void(std::function<void()>)>;  // passes a function to the studio's thread

  Jobs(Hub& hub, Post post);
  // As close().
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // A job whose `slot` is not empty replaces those of the same slot: a waiting one is dropped, a running one
  // cancelled. So only the newest setting of a slider is worked out. Its lane is the slot up to the first dot or blank.
  // Returns its id.
  std::uint64_t start(const std::string& title, const std::string& slot, Work work, Done done);
  std::uint64_t start_in(const std::string& lane, const std::string& title, const std::string& slot, Work work,
                         Done done);
  // A job that stores what cannot be made again, such as a log: the studio's end waits for it. `loss` begins the
  // sentence that states its failure: "the log feel.csv is lost".
  std::uint64_t start_storing(const std::string& lane, const std::string& title, const std::string& loss, Work work,
                              Done done);
  void cancel(std::uint64_t job);
  // The studio's end: waits for the jobs that store, and cancels or drops all others; later ones do not begin. What
  // could not be stored and was not passed to a `done`, in sentences.
  std::vector<std::string> close();
  // Throws Advice if kMostWaiting jobs are waiting: more are not begun for browsers, who may ask without end.
  void check_room() const;
  static constexpr std::size_t kMostWaiting = 200;

  void bind(Calls& calls);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Answers `request` with what `work` gives: a Json or a BlockWriter. Its error is the request's refusal. A slot is the
// browser's own, so that one window does not cancel another's work. Throws Advice as Jobs::check_room.
template <class Work>
void answer_in_lane(Jobs& jobs, const std::string& lane, const Request& request, const std::string& title,
                    const std::string& slot, Work work) {
  using Result = std::invoke_result_t<Work, const Observer&>;
  auto result = std::make_shared<std::optional<Result>>();
  jobs.check_room();
  const std::string own_slot = slot.empty() ? slot : slot + " " + std::to_string(request.client());
  jobs.start_in(
      lane, title, own_slot,
      [result, work = std::move(work)](const Observer& observer) { result->emplace(work(observer)); },
      [result, request](std::exception_ptr error) {
        if (!error) return request.answer(std::move(**result));
        try {
          std::rethrow_exception(error);
        } catch (const std::exception& fault) {
          request.refuse(fault);
        }
      });
}

// The same, in the lane of the call's page.
template <class Work>
void answer_by_job(Jobs& jobs, const Request& request, const std::string& title, const std::string& slot, Work work) {
  const std::string& call = request.name();
  answer_in_lane(jobs, call.substr(0, call.find('.')), request, title, slot, std::move(work));
}

}  // namespace asperity::studio
