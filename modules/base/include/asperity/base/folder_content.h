#pragma once

#include <filesystem>
#include <functional>

namespace asperity {

// Whether all of a folder was written by asperity, so that it may be replaced.
struct FolderContent {
  bool ours = false;
  std::filesystem::path added;  // of a folder of ours: the relative path of a file that somebody else put there

  FolderContent(bool all_ours) : ours(all_ours) {}  // NOLINT(google-explicit-constructor): most checks know yes or no
  static FolderContent with_added(const std::filesystem::path& file);
  operator bool() const { return ours; }  // NOLINT(google-explicit-constructor): as OutputFolder asks
};

// For OutputFolder: the same answer, but Error naming the file that was added to a folder of ours, and what to do.
std::function<bool(const std::filesystem::path&)> naming_added(FolderContent (*is_ours)(const std::filesystem::path&));

}  // namespace asperity
