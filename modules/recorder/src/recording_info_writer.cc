#include "recording_info_writer.h"

#include <fcntl.h>
#include <unistd.h>
#include <chrono>
#include <exception>
#include <utility>

#include "asperity/recording/write_recording.h"

namespace asperity {

RecordingInfoWriter::RecordingInfoWriter(std::filesystem::path folder, double sync_s)
    : folder_(std::move(folder)), sync_s_(sync_s), thread_([this] { run(); }) {}

RecordingInfoWriter::~RecordingInfoWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RecordingInfoWriter::put(const RecordingInfo& info) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = info;
  }
  changed_.notify_all();
}

void RecordingInfoWriter::run() {
  using Clock = std::chrono::steady_clock;
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(sync_s_));
  Clock::time_point next_sync = Clock::now() + period;
  const auto has_work = [this] { return stop_ || waiting_; };
  std::unique_lock lock(mutex_);
  for (;;) {
    if (sync_s_ > 0.0) {
      changed_.wait_until(lock, next_sync, has_work);
    } else {
      changed_.wait(lock, has_work);
    }
    if (stop_) return;
    std::optional<RecordingInfo> info = std::exchange(waiting_, std::nullopt);
    lock.unlock();
    try {
      if (info) replace_recording_info(folder_ / "recording.json", *info);
    } catch (const std::exception&) {
      // A disk that takes no more is found by the rows, and the end writes a last one.
    }
    if (sync_s_ > 0.0 && Clock::now() >= next_sync) {
      sync();
      next_sync = Clock::now() + period;
    }
    lock.lock();
  }
}

void RecordingInfoWriter::sync() const {
  for (const char* name : {"recording.json", "probe.csv", "tracker.csv", "."}) {
    const int file = ::open((folder_ / name).c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) continue;
    ::fsync(file);  // what fails here, the writing itself finds out
    ::close(file);
  }
}

}  // namespace asperity
