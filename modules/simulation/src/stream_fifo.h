#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace asperity {

// The writing end of a FIFO that it makes and removes. The process must not die of SIGPIPE.
class StreamFifo {
 public:
  explicit StreamFifo(std::filesystem::path path);
  ~StreamFifo();
  StreamFifo(const StreamFifo&) = delete;
  StreamFifo& operator=(const StreamFifo&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // True if there is a reader; `is_new` tells that it has just come, and nothing has been written to it.
  bool open(bool& is_new);
  bool is_open() const { return file_ >= 0; }

  // Waits at most `timeout_ms` until some bytes can be written and writes them; how many. The reader's going away
  // closes the writing end.
  std::size_t write(std::span<const char> bytes, int timeout_ms);
  void close();

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace asperity
