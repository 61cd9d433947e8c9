#include "asperity/studio/jobs.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace asperity::studio {

namespace {

struct Job {
  std::uint64_t id = 0;
  std::string title, slot;
  std::string loss;  // empty: it stores nothing that cannot be made again
  Jobs::Work work;
  Jobs::Done done;
  std::atomic<bool> cancelled{false};
};

std::string lane_of(const std::string& slot) { return slot.substr(0, slot.find_first_of(". ")); }

// Why a job failed; nothing if it was cancelled.
std::optional<std::string> reason_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const std::exception& fault) {
    return fault.what();
  } catch (...) {
    return "unknown error";
  }
}

// What jobs could not store. Thread-safe.
class UnstatedLosses {
 public:
  void add(const Job& job, const std::exception_ptr& error) {
    if (job.loss.empty() || !error) return;
    const std::optional<std::string> reason = reason_of(error);
    const std::lock_guard lock(mutex_);
    if (reason) sentences_[job.id] = job.loss + ": " + *reason;
  }
  void remove(const Job& job) {
    const std::lock_guard lock(mutex_);
    sentences_.erase(job.id);
  }
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> out;
    for (const auto& [id, sentence] : std::exchange(sentences_, {})) out.push_back(sentence);
    return out;
  }

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, std::string> sentences_;
};

// The states of all running jobs, sent to the browsers as they change. Thread-safe.
class Board {
 public:
  explicit Board(Hub& hub) : hub_(hub) {}

  UnstatedLosses losses;

  void send_progress(const Job& job, std::string_view stage, double fraction, std::string_view state,
                     const Json& fault = {}) {
    if (job.title.empty()) return;
    Json data;
    data["id"] = job.id;
    data["title"] = job.title;
    data["stage"] = stage;
    data["fraction"] = fraction;
    data["state"] = state;
    if (!fault.is_null()) data.update(fault);
    {
      const std::lock_guard lock(mutex_);
      if (state == "waiting" || state == "running") {
        states_[job.id] = data;
      } else {
        states_.erase(job.id);
      }
    }
    hub_.broadcast("job", data);
  }

  Json list() const {
    const std::lock_guard lock(mutex_);
    Json out = Json::array();
    for (const auto& [id, state] : states_) out.push_back(state);
    return out;
  }

 private:
  Hub& hub_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, Json> states_;
};

// At most ten times a second, so that short stages do not flood the browsers.
class Progress {
 public:
  Progress(Board& board, const Job& job) : board_(board), job_(job) {}
  void operator()(std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    board_.send_progress(job_, stage, fraction, "running");
  }

 private:
  Board& board_;
  const Job& job_;
  std::chrono::steady_clock::time_point last_;
};

std::exception_ptr do_work(Board& board, Job& job) {
  try {
    board.send_progress(job, "", 0.0, "running");
    Progress progress(board, job);
    Observer observer;
    observer.progress = [&](std::string_view stage, double fraction) { progress(stage, fraction); };
    observer.cancelled = [&] { return job.cancelled.load(); };
    observer.update("", 0.0);
    job.work(observer);
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

void send_end(Board& board, const Job& job, std::exception_ptr error) {
  try {
    if (!error) return board.send_progress(job, "", 1.0, "done");
    std::rethrow_exception(error);
  } catch (const Cancelled&) {
    board.send_progress(job, "", 1.0, "cancelled");
  } catch (const Advice& advice) {
    board.send_progress(job, "", 1.0, "failed", {{"message", advice.what()}, {"hint", advice.hint()}});
  } catch (const std::exception& fault) {
    board.send_progress(job, "", 1.0, "failed", {{"message", fault.what()}, {"hint", ""}});
  }
}

// The jobs of one lane, one after another on a thread of its own.
class Lane {
 public:
  Lane(Board& board, const Jobs::Post& post) : board_(board), post_(post), thread_([this] { run(); }) {}
  ~Lane() {
    end();
    thread_.join();
  }
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;

  // Does not wait. What stores is still done.
  void end() {
    std::vector<std::shared_ptr<Job>> dropped;
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      if (running_ && running_->loss.empty()) running_->cancelled = true;
      dropped = take_waiting([](const Job& job) { return job.loss.empty(); });
    }
    woken_.notify_all();
  }

  void add(const std::shared_ptr<Job>& job) {
    std::vector<std::shared_ptr<Job>> dropped;
    {
      const std::lock_guard lock(mutex_);
      if (!job->slot.empty()) {
        if (running_ && running_->slot == job->slot) running_->cancelled = true;
        dropped = take_waiting([&](const Job& old) { return old.slot == job->slot; });
      }
      waiting_.push_back(job);
    }
    board_.send_progress(*job, "", 0.0, "waiting");
    for (const auto& old : dropped) finish(old, std::make_exception_ptr(Cancelled()));
    woken_.notify_all();
  }

  std::size_t waiting() {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }

  void cancel(std::uint64_t id) {
    std::vector<std::shared_ptr<Job>> dropped;
    {
      const std::lock_guard lock(mutex_);
      if (running_ && running_->id == id) running_->cancelled = true;
      dropped = take_waiting([&](const Job& job) { return job.id == id; });
    }
    for (const auto& old : dropped) finish(old, std::make_exception_ptr(Cancelled()));
  }

 private:
  template <class Which>
  std::vector<std::shared_ptr<Job>> take_waiting(Which which) {
    std::vector<std::shared_ptr<Job>> out;
    std::deque<std::shared_ptr<Job>> rest;
    for (auto& job : waiting_) {
      if (which(*job)) {
        out.push_back(std::move(job));
      } else {
        rest.push_back(std::move(job));
      }
    }
    waiting_ = std::move(rest);
    return out;
  }

  void run() {
    for (;;) {
      std::shared_ptr<Job> job;
      {
        std::unique_lock lock(mutex_);
        running_.reset();
        woken_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        job = waiting_.front();
        waiting_.pop_front();
        running_ = job;
      }
      finish(job, do_work(board_, *job));
    }
  }

  // The work's objects are destroyed on the studio's thread, where they were made. Its end is reported when its result
  // can be seen.
  void finish(const std::shared_ptr<Job>& job, std::exception_ptr error) {
    board_.losses.add(*job, error);
    post_([board = &board_, job, error] {
      if (job->done) job->done(error);
      board->losses.remove(*job);
      job->work = nullptr;
      job->done = nullptr;
      send_end(*board, *job, error);
    });
  }

  Board& board_;
  const Jobs::Post& post_;
  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace

struct Jobs::Impl {
  Board board;
  Post post;
  std::map<std::string, Lane> lanes;
  std::uint64_t last_id = 0;
  bool is_closed = false;

  Impl(Hub& hub, Post its_post) : board(hub), post(std::move(its_post)) {}

  std::uint64_t start(const std::string& lane, const std::shared_ptr<Job>& job) {
    job->id = ++last_id;
    if (!is_closed) lanes.try_emplace(lane, board, post).first->second.add(job);
    return job->id;
  }
};

Jobs::Jobs(Hub& hub, Post post) : impl_(std::make_unique<Impl>(hub, std::move(post))) {}
Jobs::~Jobs() { close(); }

std::vector<std::string> Jobs::close() {
  impl_->is_closed = true;
  for (auto& [name, lane] : impl_->lanes) lane.end();
  impl_->lanes.clear();
  return impl_->board.losses.take();
}

std::uint64_t Jobs::start(const std::string& title, const std::string& slot, Work work, Done done) {
  return start_in(lane_of(slot), title, slot, std::move(work), std::move(done));
}

std::uint64_t Jobs::start_in(const std::string& lane, const std::string& title, const std::string& slot, Work work,
                             Done done) {
  auto job = std::make_shared<Job>();
  job->title = title;
  job->slot = slot;
  job->work = std::move(work);
  job->done = std::move(done);
  return impl_->start(lane, job);
}

std::uint64_t Jobs::start_storing(const std::string& lane, const std::string& title, const std::string& loss, Work work,
                                  Done done) {
  auto job = std::make_shared<Job>();
  job->title = title;
  job->loss = loss;
  job->work = std::move(work);
  job->done = std::move(done);
  return impl_->start(lane, job);
}

void Jobs::cancel(std::uint64_t id) {
  for (auto& [name, lane] : impl_->lanes) lane.cancel(id);
}

void Jobs::check_room() const {
  std::size_t waiting = 0;
  for (auto& [name, lane] : impl_->lanes) waiting += lane.waiting();
  if (waiting >= kMostWaiting)
    throw Advice("too many jobs are waiting", "Wait until some are done, or cancel them below.");
}

void Jobs::bind(Calls& calls) {
  calls.add("job.cancel", [this](const Request& request) {
    cancel(static_cast<std::uint64_t>(request.integer("job")));
    request.done();
  });
  calls.add("job.list", [this](const Request& request) { request.answer(impl_->board.list()); });
}

}  // namespace asperity::studio
