#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity::studio {

// A folder that a studio of this user worked in.
struct RecentProject {
  std::string folder;  // absolute
  std::string opened;  // UTC, "2026-11-29T09:00:00Z"
  int port = 0;        // of the last studio there; 0: not known
};

inline constexpr std::size_t kMostRecentProjects = 12;

// The newest first. A file that is not there or cannot be read gives none: nothing depends on it.
std::vector<RecentProject> read_recent_projects(const std::filesystem::path& file);

// Puts `project` in front, in the place of the entry of the same folder. Throws Error if the file cannot be written.
void add_recent_project(const std::filesystem::path& file, const RecentProject& project);

// The port of the last studio in `folder`; 0 if none is known.
int remembered_port(const std::filesystem::path& file, const std::string& folder);

}  // namespace asperity::studio
