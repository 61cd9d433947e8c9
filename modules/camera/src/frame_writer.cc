#include "asperity/camera/frame_writer.h"

#include <exception>
#include <fstream>
#include <utility>

#include "asperity/base/error.h"
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
  std::filesystem::create_directories(folder_);
  // First under another name: whoever dies in between leaves no half an image.
  const std::filesystem::path path = folder_ / (std::to_string(frame.t_ns) + ".png");
  const std::filesystem::path temporary = folder_ / ".png.new";
  std::ofstream out(temporary, std::ios::binary);
  out.write(png.data(), static_cast<std::streamsize>(png.size()));
  out.close();
  if (!out) throw Error(path.string() + ": cannot be written");
  std::filesystem::rename(temporary, path);
}

}  // namespace asperity
