#pragma once

#include <filesystem>

namespace asperity::studio {

// Holds a folder for one studio: two of them would overwrite each other's state. A folder that cannot be written is not
// locked, for nothing is written there.
class FolderLock {
 public:
  // Throws Error if another studio has it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace asperity::studio
