#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/device/replay_device.h"

namespace asperity {

struct ReplayFile {
  std::vector<ReplaySample> samples;
  Problems problems;
};

// Reads a trajectory.csv or any CSV with the columns px_m,py_m,pz_m (m) and t_ns, or t_s, rising. Without a time the
// rows are a millisecond apart. Rows whose position is nan are passed over and counted. Throws Error naming file, line
// and column for a missing column, a cell that is not a number, a position beyond 10^6 m, times that do not rise,
// no row at all, or a file over 1 GiB.
ReplayFile read_replay_csv(const std::filesystem::path& file);

// The same from text in memory, which messages call `name`.
ReplayFile parse_replay_csv(std::string_view text, const std::string& name);

}  // namespace asperity
