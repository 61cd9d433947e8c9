#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace asperity::cli {

// Waits until the program has begun what it writes to `target`: its temporary file or folder is there. False if that
// takes more than a minute.
inline bool wait_until_begun(const std::filesystem::path& target) {
  const std::string temporary = "." + target.filename().string() + ".tmp-";
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    for (const auto& entry : std::filesystem::directory_iterator(target.parent_path())) {
      if (entry.path().filename().string().starts_with(temporary)) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace asperity::cli
