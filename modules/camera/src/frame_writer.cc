#include "asperity/camera/frame_writer.h"

#include <exception>
#include <system_error>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/sync_folder.h"
#include "asperity/image/png_image.h"

namespace asperity {

FrameWriter::FrameWriter(std::filesystem::path folder, std::size_t most_waiting)
    : folder_(std::move(folder)), most_waiting_(most_waiting), thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() { finish(); }

void FrameWriter::push(const CameraFrame& frame) {
  {
    const std::lock_guard lock(mutex_);
    if (stop_ || !counts_.failure.empty() || waiting_.size() >= most_waiting_) {
      ++counts_.dropped;
      return;
    }
    waiting_.push_back(frame);
  }
  changed_.notify_all();
}

FrameWriter::FrameCounts FrameWriter::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void FrameWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const CameraFrame frame = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    std::string failure;
    try {
      write(frame);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    lock.lock();
    if (failure.empty()) {
      ++counts_.written;
      continue;
    }
    counts_.failure = failure;
    counts_.dropped += waiting_.size() + 1;
    waiting_.clear();
  }
}

void FrameWriter::write(const CameraFrame& frame) const {
  const std::size_t size = static_cast<std::size_t>(frame.image.width) * static_cast<std::size_t>(frame.image.height);
  if (size == 0 || frame.image.pixels.size() != size) throw Error("frames: an image of no size");
  const std::string png = format_png(frame.image);
  make_folder();
  write_file(folder_ / (std::to_string(frame.t_ns) + ".png"), png);
}

void FrameWriter::make_folder() const {
  std::error_code error;
  const bool is_new = std::filesystem::create_directories(folder_, error);
  if (error) throw Error(folder_.string() + ": cannot be made: " + error.message());
  // Images that are forced to the disk are of no use in a folder whose name is not.
  if (is_new) sync_folder(folder_.parent_path());
}

}  // namespace asperity
