#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_result.h"

namespace asperity {

Json vector_json(const Eigen::Vector3d& v);
// [x, y, z, qw, qx, qy, qz]
Json pose_json(const Pose& pose);
Json problems_json(const Problems& problems);
// format_result.cc
Json lines_json(std::span<const RepeatedLine> lines);

}  // namespace asperity
