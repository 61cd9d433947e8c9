#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"

namespace asperity {

// Keys keep the order in which they were set.
using Json = nlohmann::ordered_json;

// JSON has no nan and no infinity.
inline Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector_json(const Eigen::Vector3d& v);
// [x, y, z, qw, qx, qy, qz]
Json pose_json(const Pose& pose);
Json problems_json(const Problems& problems);

}  // namespace asperity
