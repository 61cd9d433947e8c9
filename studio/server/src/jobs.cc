#include "asperity/studio/jobs.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace asperity::studio {

namespace {

struct Job {
  std::uint64_t id = 0;
  std::string title, slot;
  Jobs::Work work;
  Jobs::Done done;
  std::atomic<bool> cancelled{false};
};

void tell(Hub& hub, const Job& job, std::string_view stage, double fraction, std::string_view state) {
  Json data;
  data["id"] = job.id;
  data["title"] = job.title;
  data["stage"] = stage;
  data["fraction"] = fraction;
  data["state"] = state;
  hub.broadcast("job", data);
}

// At most ten times a second, so that short stages do not flood the browsers.
class Progress {
 public:
  Progress(Hub& hub, const Job& job) : hub_(hub), job_(job) {}
  void operator()(std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    tell(hub_, job_, stage, fraction, "running");
  }

 private:
  Hub& hub_;
  const Job& job_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace

struct Jobs::Impl {
  Hub& hub;
  Post post;
  std::mutex mutex;
  std::condition_variable woken;
  std::deque<std::shared_ptr<Job>> waiting;
  std::shared_ptr<Job> running;
  bool ending = false;
  std::uint64_t last_id = 0;
  std::thread thread;

  Impl(Hub& its_hub, Post its_post) : hub(its_hub), post(std::move(its_post)) {}

  void run() {
    for (;;) {
      std::shared_ptr<Job> job;
      {
        std::unique_lock lock(mutex);
        running.reset();
        woken.wait(lock, [&] { return ending || !waiting.empty(); });
        if (ending) return;
        job = waiting.front();
        waiting.pop_front();
        running = job;
      }
      finish(job, do_work(*job));
    }
  }

  std::exception_ptr do_work(Job& job) {
    tell(hub, job, "", 0.0, "running");
    Progress progress(hub, job);
    Observer observer;
    observer.progress = [&](std::string_view stage, double fraction) { progress(stage, fraction); };
    observer.cancelled = [&] { return job.cancelled.load(); };
    try {
      observer.update("", 0.0);
      job.work(observer);
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }

  void finish(const std::shared_ptr<Job>& job, std::exception_ptr error) {
    std::string_view state = "done";
    try {
      if (error) std::rethrow_exception(error);
    } catch (const Cancelled&) {
      state = "cancelled";
    } catch (...) {
      state = "failed";
    }
    tell(hub, *job, "", 1.0, state);
    // What the work holds is let go on the studio's thread, where it was made.
    post([job, error] {
      if (job->done) job->done(error);
      job->work = nullptr;
      job->done = nullptr;
    });
  }
};

Jobs::Jobs(Hub& hub, Post post) : impl_(std::make_unique<Impl>(hub, std::move(post))) {
  impl_->thread = std::thread([this] { impl_->run(); });
}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->ending = true;
    if (impl_->running) impl_->running->cancelled = true;
  }
  impl_->woken.notify_all();
  impl_->thread.join();
}

std::uint64_t Jobs::start(const std::string& title, const std::string& slot, Work work, Done done) {
  auto job = std::make_shared<Job>();
  job->title = title;
  job->slot = slot;
  job->work = std::move(work);
  job->done = std::move(done);
  std::deque<std::shared_ptr<Job>> dropped;
  {
    const std::lock_guard lock(impl_->mutex);
    job->id = ++impl_->last_id;
    if (!slot.empty()) {
      if (impl_->running && impl_->running->slot == slot) impl_->running->cancelled = true;
      for (auto at = impl_->waiting.begin(); at != impl_->waiting.end();) {
        if ((*at)->slot != slot) {
          ++at;
          continue;
        }
        dropped.push_back(*at);
        at = impl_->waiting.erase(at);
      }
    }
    impl_->waiting.push_back(job);
  }
  tell(impl_->hub, *job, "", 0.0, "waiting");
  for (const auto& old : dropped) impl_->finish(old, std::make_exception_ptr(Cancelled()));
  impl_->woken.notify_all();
  return job->id;
}

void Jobs::cancel(std::uint64_t id) {
  std::shared_ptr<Job> dropped;
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->running && impl_->running->id == id) impl_->running->cancelled = true;
    for (auto at = impl_->waiting.begin(); at != impl_->waiting.end(); ++at) {
      if ((*at)->id != id) continue;
      dropped = *at;
      impl_->waiting.erase(at);
      break;
    }
  }
  if (dropped) impl_->finish(dropped, std::make_exception_ptr(Cancelled()));
}

void Jobs::bind(Calls& calls) {
  calls.add("job.cancel", [this](const Request& request) {
    cancel(static_cast<std::uint64_t>(request.integer("job")));
    request.done();
  });
}

}  // namespace asperity::studio
