#pragma once

#include <array>
#include <optional>
#include <string>

#include "asperity/geometry/pose.h"
#include "asperity/recording/read_limits.h"
#include "csv_rows.h"

namespace asperity {

// Where a pose's seven columns are.
struct PoseColumns {
  Columns3 position;
  std::array<std::size_t, 4> rotation;

  // Names with `prefix` before them.
  explicit PoseColumns(const CsvReader& csv, const std::string& prefix = {});
};

// The row's pose, or nullopt with a problem.
std::optional<Pose> row_pose(const CsvReader& csv, const PoseColumns& columns, const ReadLimits& limits,
                             RowProblems& problems);

}  // namespace asperity
