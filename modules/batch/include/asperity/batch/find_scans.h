#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity {

struct BatchScan {
  std::string name;  // of its results: its path below the folder that all have in common, with '/'
  std::string path;  // of the recording, relative to the plan's folder where the pattern is
};

// The recordings that `patterns` mean, relative to `folder`, each once, in the order of their names. In a pattern `*`,
// `?` and `[…]` stand within one name and `**` for any number of folders; of what a pattern finds only recordings
// (folders with a recording.json) are taken, and hidden folders are passed over. Throws Error for a path without such
// signs that is not a recording, and for a pattern that finds none.
std::vector<BatchScan> find_scans(const std::filesystem::path& folder, const std::vector<std::string>& patterns);

// A scan's name as one file's name: `s1/scan` as `s1-scan`.
std::string flat_name(const std::string& name);

}  // namespace asperity
