#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "asperity/camera/camera_source.h"

namespace asperity {

// Keeps camera images as PNG files named by their t_ns, as in the frames/ of a recording, in a thread of its own.
// Each is whole and forced to the disk under its name, or not there. Images that come faster than they can be written
// are dropped and counted; with the first that the disk refuses none are written any more.
class FrameWriter {
 public:
  // `folder` is made with the first image.
  explicit FrameWriter(std::filesystem::path folder, std::size_t most_waiting = 64);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Any thread; copies the image and does not wait for the disk.
  void push(const CameraFrame& frame);

  struct FrameCounts {
    std::uint64_t written = 0;
    std::uint64_t dropped = 0;
    std::string failure;  // why none are written any more, naming the file; empty: nothing is wrong
  };
  FrameCounts counts() const;
  // Writes what waits.
  void finish();

 private:
  void run();
  void write(const CameraFrame& frame) const;
  void make_folder() const;

  std::filesystem::path folder_;
  std::size_t most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<CameraFrame> waiting_;
  bool stop_ = false;
  FrameCounts counts_;
  std::thread thread_;
};

}  // namespace asperity
