#pragma once

#include <string_view>

#include <Eigen/Core>

#include "asperity/json/json_object.h"

namespace asperity {

// Leave `out` as it is if the key is absent; throw Error as JsonObject does.
void read_vector(JsonObject& object, std::string_view key, Eigen::Vector3d& out, Range range = {});
// Three rows of `columns` numbers each.
void read_matrix(JsonObject& object, std::string_view key, Eigen::Matrix<double, 3, Eigen::Dynamic>& out,
                 std::size_t columns);

}  // namespace asperity
