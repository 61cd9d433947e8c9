#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "raw_client.h"

namespace asperity::cli {

// A browser's window at a studio that runs as a program, without the browser: it calls, and keeps the lease by its
// heartbeats, ten a second, from a thread of its own.
class StudioWindow {
 public:
  // The studio that writes its address to `out` (its standard output) within 30 s. Throws std::runtime_error.
  explicit StudioWindow(const std::filesystem::path& out);
  ~StudioWindow();

  // The answer; throws std::runtime_error with the studio's words if it is an error.
  nlohmann::json call(const std::string& name, const nlohmann::json& arguments = nlohmann::json::object());
  void edit(const std::string& path, const nlohmann::json& value);

  // Takes the lease and keeps it until this object goes; a studio that does not answer any more ends it too.
  void keep_lease();

 private:
  static studio::RawClient connect(const std::filesystem::path& out);

  studio::RawClient client_;
  std::mutex mutex_;
  int last_id_ = 0;
  std::atomic<bool> leaving_{false};
  std::thread heart_;
};

}  // namespace asperity::cli
