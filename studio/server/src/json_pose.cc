#include "json_pose.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/base/error.h"

namespace asperity::studio {

namespace {

template <std::size_t N>
std::array<double, N> numbers_of(const Json& json, std::string_view what) {
  constexpr double kFarthest = 1e6;
  std::array<double, N> out{};
  const bool right_count = json.is_array() && json.size() == N;
  for (std::size_t i = 0; right_count && i < N; ++i) {
    if (json[i].is_number()) out[i] = json[i].get<double>();
    if (json[i].is_number() && std::isfinite(out[i]) && std::abs(out[i]) <= kFarthest) continue;
    throw Error(std::string(what) + ": number " + std::to_string(i + 1) + " is not finite, or beyond a million");
  }
  if (!right_count) throw Error(std::string(what) + " is not " + std::to_string(N) + " numbers");
  return out;
}

}  // namespace

Json json_of_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json json_of_pose(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation_m;
  Eigen::Quaterniond q = pose.rotation;
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

Eigen::Vector3d point_of_json(const Json& json, std::string_view what) {
  const std::array<double, 3> v = numbers_of<3>(json, what);
  return {v[0], v[1], v[2]};
}

Pose pose_of_json(const Json& json, std::string_view what) {
  constexpr double kUnit = 1e-6;
  const std::array<double, 7> v = numbers_of<7>(json, what);
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  if (!(std::abs(q.norm() - 1.0) <= kUnit)) {
    throw Error(std::string(what) + ": its quaternion has the length " + std::to_string(q.norm()) + ", not 1");
  }
  // What was made unit once stays as it is, to the last digit: poses are distinguished by their numbers.
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  Eigen::Quaterniond unit = std::abs(q.norm() - 1.0) < kRounding ? q : q.normalized();
  if (unit.w() < 0.0) unit.coeffs() = -unit.coeffs();
  return {unit, Eigen::Vector3d(v[0], v[1], v[2])};
}

}  // namespace asperity::studio
