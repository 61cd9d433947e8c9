#pragma once

#include <filesystem>

namespace asperity::studio {

// A folder of its own among the system's temporary ones, gone with all that is in it at the end. While it is there it
// is locked; the lock of a process that was killed is free.
class TemporaryFolder {
 public:
  // Throws Error if none can be made in `where`.
  explicit TemporaryFolder(const std::filesystem::path& where = std::filesystem::temp_directory_path());
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

// Removes what processes that were killed have left in `where`: folders with a TemporaryFolder's name and mark that
// belong to this user and that nobody holds. Links are not followed. Never throws; what cannot be removed stays.
void remove_stale_temporary_folders(
    const std::filesystem::path& where = std::filesystem::temp_directory_path()) noexcept;

}  // namespace asperity::studio
