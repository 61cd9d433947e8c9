#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"

namespace asperity {

Json vector_json(const Eigen::Vector3d& v);
// [x, y, z, qw, qx, qy, qz]
Json pose_json(const Pose& pose);
Json problems_json(const Problems& problems);
Json config_object(const std::vector<ConfigField>& fields);

}  // namespace asperity
