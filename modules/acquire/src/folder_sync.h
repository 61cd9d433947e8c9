#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

namespace asperity {

// Forces a recording's files to the disk every `period_s` in a thread of its own, so that nobody waits for that who
// has rows to write. A failure is left to the writing itself to find.
class FolderSync {
 public:
  FolderSync(std::filesystem::path folder, double period_s);  // 0: never
  ~FolderSync();
  FolderSync(const FolderSync&) = delete;
  FolderSync& operator=(const FolderSync&) = delete;

 private:
  void run();

  std::filesystem::path folder_;
  double period_s_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace asperity
