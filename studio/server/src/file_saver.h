#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace asperity::studio {

// Writes a file again and again from a thread of its own, by rename, the newest content only: a slow disk delays
// nobody. What could not be written is tried again every two seconds, and at the end.
class FileSaver {
 public:
  // `failed` is called on the saver's thread with the reason.
  FileSaver(std::filesystem::path file, std::function<void(std::string)> failed);
  ~FileSaver();
  FileSaver(const FileSaver&) = delete;
  FileSaver& operator=(const FileSaver&) = delete;

  void save(std::string content);
  // Writes what waits, and ends. Why that could not be written; "" if all is on the disk.
  std::string finish();

 private:
  void run();

  std::filesystem::path file_;
  std::function<void(std::string)> failed_;
  std::mutex mutex_;
  std::condition_variable woken_;
  std::optional<std::string> waiting_;
  bool ending_ = false;
  std::string lost_;  // why the last content could not be written at the end
  std::thread thread_;
};

}  // namespace asperity::studio
