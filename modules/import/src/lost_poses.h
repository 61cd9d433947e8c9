#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asperity/import/body_frame.h"
#include "asperity/import/import_table.h"

namespace asperity {

// What several trackers write while they do not see the body: position 0 and no rotation. Such rows are taken out of
// `rotation` where the poses beside them are further away than 1 mm and ten times the usual step, with a Problem
// "lost_poses". Gives their number. Positions in metres.
std::size_t leave_out_zero_poses(const ImportTable& in, const std::array<std::vector<double>, 3>& position,
                                 std::vector<std::optional<Eigen::Quaterniond>>& rotation, Problems& problems);

// Other trackers repeat the last pose. Rows that repeat the pose before them to the last digit while the sensor rotates
// by more than 0.02 rad, with and without its offset from the poses' rotation, are left out; without a gyroscope
// while the specific force varies by more than 1 m/s² RMS. The streams are on one clock, the sensor in the body's axes.
void leave_out_frozen_poses(const std::string& file, ImportStreams& streams);

}  // namespace asperity
