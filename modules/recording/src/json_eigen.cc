#include "json_eigen.h"

#include <fmt/format.h>

namespace asperity {

void read_vector(JsonObject& object, std::string_view key, Eigen::Vector3d& out, Range range) {
  object.read_numbers(key, out.data(), 3, range);
}

void read_matrix(JsonObject& object, std::string_view key, Eigen::Matrix<double, 3, Eigen::Dynamic>& out,
                 std::size_t columns) {
  const auto value = object.optional(key);
  if (!value) return;
  const Json& rows = value->json();
  if (!rows.is_array() || rows.size() != 3) value->fail("must be an array of 3 rows");
  const std::size_t width = rows[0].is_array() ? rows[0].size() : 0;
  if (width != columns) value->fail(fmt::format("its first row has {} numbers; allowed: {}", width, columns));
  out.resize(3, static_cast<Eigen::Index>(width));
  for (std::size_t row = 0; row < 3; ++row) {
    if (!rows[row].is_array() || rows[row].size() != width) {
      value->fail(fmt::format("row {} must have {} numbers", row + 1, width));
    }
    Eigen::RowVectorXd cells(out.cols());
    value->element(row).numbers(cells.data(), width);
    out.row(static_cast<Eigen::Index>(row)) = cells;
  }
}

}  // namespace asperity
