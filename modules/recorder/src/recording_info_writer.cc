#include "recording_info_writer.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/recording/write_recording.h"

namespace asperity {

RecordingInfoWriter::RecordingInfoWriter(std::filesystem::path folder, const std::vector<TrackedBody>& bodies,
                                         double sync_s)
    : folder_(std::move(folder)),
      files_{"recording.json", "probe.csv", "tracker.csv", "checksums.txt", "."},
      sync_s_(sync_s) {
  for (const TrackedBody& body : bodies) files_.push_back(body_file(body.name));
  thread_ = std::thread([this] { run(); });
}

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

std::string RecordingInfoWriter::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
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
    std::string failure;
    try {
      if (info) write_recording_info(folder_ / "recording.json", *info);
      if (sync_s_ > 0.0 && Clock::now() >= next_sync) {
        next_sync = Clock::now() + period;
        sync();
      }
    } catch (const std::exception& error) {
      failure = error.what();
    }
    lock.lock();
    if (failure_.empty()) failure_ = std::move(failure);
  }
}

void RecordingInfoWriter::sync() const {
  for (const std::string& name : files_) {
    const int file = ::open((folder_ / name).c_str(), O_RDONLY | O_CLOEXEC);
    const bool done = file >= 0 && ::fsync(file) == 0;
    const std::string reason = std::strerror(errno);
    if (file >= 0) ::close(file);
    if (!done) throw Error((folder_ / name).string() + ": cannot be forced to the disk: " + reason);
  }
}

}  // namespace asperity
