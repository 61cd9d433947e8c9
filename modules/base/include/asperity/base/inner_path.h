#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// A path written in a file, if it is relative and does not climb; backslashes count as slashes.
inline std::optional<std::string> inner_path(std::string_view written) {
  std::string path(written);
  for (char& c : path) {
    if (c == '\\') c = '/';
  }
  const bool has_drive = path.size() > 1 && path[1] == ':';
  if (path.empty() || path.front() == '/' || has_drive || path.find('\0') != std::string::npos) return std::nullopt;
  for (const std::filesystem::path& part : std::filesystem::path(path)) {
    if (part == "..") return std::nullopt;
  }
  return path;
}

// The file that `written` names inside `folder`, links followed; none if it would lie outside. Throws std::bad_alloc
// without memory, and Error if the disk cannot be read: neither states where the file is.
std::optional<std::filesystem::path> inner_file(const std::filesystem::path& folder, std::string_view written);

}  // namespace asperity
