#include "asperity/profile/measure_areal_roughness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

std::size_t check_areal_map(const ArealMap& map, const ArealRoughnessConfig& config) {
  if (map.columns < 2 || map.rows < 2 || map.height_m.size() != map.columns * map.rows) {
    throw Error("areal roughness: " + std::to_string(map.height_m.size()) + " heights for a map of " +
                std::to_string(map.columns) + " by " + std::to_string(map.rows) + " points");
  }
  for (const double spacing_m : {map.x_spacing_m, map.y_spacing_m}) {
    if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
      throw Error("areal roughness: the spacing " + number_text(spacing_m) + " m is not a positive length");
    }
  }
  std::size_t missing = 0;
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    if (std::isinf(map.height_m[i])) {
      throw Error("areal roughness: the height in row " + std::to_string(i / map.columns + 1) + ", column " +
                  std::to_string(i % map.columns + 1) + " is infinite");
    }
    if (std::isnan(map.height_m[i])) ++missing;
  }
  if (missing + 3 > map.height_m.size() ||
      static_cast<double>(missing) > config.max_missing * static_cast<double>(map.height_m.size())) {
    throw Error("areal roughness: " + std::to_string(missing) + " of " + std::to_string(map.height_m.size()) +
                " heights are missing; allowed is a part of " + number_text(config.max_missing));
  }
  return missing;
}

// Calls `take(x, y, z)` for each present sample; x and y are grid steps from the middle of the map.
template <class Take>
void for_each_sample(const ArealMap& map, const Take& take) {
  const double middle_x = 0.5 * static_cast<double>(map.columns - 1);
  const double middle_y = 0.5 * static_cast<double>(map.rows - 1);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const double z = map.at(row, column);
      if (!std::isnan(z)) take(static_cast<double>(column) - middle_x, static_cast<double>(row) - middle_y, z);
    }
  }
}

// Height in the middle and slope a grid step in x and in y.
Eigen::Vector3d fit_plane(const ArealMap& map, double mean_m) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for_each_sample(map, [&](double x, double y, double z) {
    const Eigen::Vector3d basis(1.0, x, y);
    normal += basis * basis.transpose();
    right += basis * (z - mean_m);
  });
  const LeastSquares fit = least_squares(normal, right);
  if (fit.rank < 3) throw Error("areal roughness: the heights present lie on a line and fix no plane");
  return fit.x + Eigen::Vector3d(mean_m, 0.0, 0.0);
}

}  // namespace

ArealRoughnessResult measure_areal_roughness(const ArealMap& map, const ArealRoughnessConfig& config) {
  ArealRoughnessResult result;
  result.samples = map.height_m.size();
  result.missing = check_areal_map(map, config);
  const double count = static_cast<double>(result.samples - result.missing);

  double mean_m = 0.0;
  for_each_sample(map, [&](double, double, double z) { mean_m += z / count; });
  Eigen::Vector3d plane(mean_m, 0.0, 0.0);
  if (config.remove_plane) plane = fit_plane(map, mean_m);
  result.slope_x = plane.y() / map.x_spacing_m;
  result.slope_y = plane.z() / map.y_spacing_m;

  double sum1 = 0.0, sum2 = 0.0, sum3 = 0.0, sum4 = 0.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for_each_sample(map, [&](double x, double y, double z) {
    const double height = z - (plane.x() + plane.y() * x + plane.z() * y);
    const double square = height * height;
    sum1 += std::abs(height);
    sum2 += square;
    sum3 += square * height;
    sum4 += square * square;
    low = std::min(low, height);
    high = std::max(high, height);
  });
  result.Sa_m = sum1 / count;
  result.Sq_m = std::sqrt(sum2 / count);
  result.Sp_m = high;
  result.Sv_m = -low;
  result.Sz_m = high - low;
  const bool flat = result.Sq_m == 0.0;
  result.Ssk = flat ? kNan : sum3 / count / (result.Sq_m * result.Sq_m * result.Sq_m);
  result.Sku = flat ? kNan : sum4 / count / (result.Sq_m * result.Sq_m * result.Sq_m * result.Sq_m);
  return result;
}

}  // namespace asperity
