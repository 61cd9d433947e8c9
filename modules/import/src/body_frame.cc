#include "asperity/import/body_frame.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "pose_at.h"

namespace asperity {

namespace {

std::vector<std::string_view> parts_between_commas(std::string_view text) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t end = std::min(text.find(','), text.size());
    out.push_back(trim(text.substr(0, end)));
    if (end == text.size()) return out;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

Eigen::Vector3d axis_vector(std::string_view name, std::string_view what) {
  std::string_view axis = trim(name);
  const double sign = axis.starts_with('-') ? -1.0 : 1.0;
  if (axis.starts_with('-') || axis.starts_with('+')) axis.remove_prefix(1);
  if (axis.size() == 1 && axis.front() >= 'x' && axis.front() <= 'z') {
    return sign * Eigen::Vector3d::Unit(axis.front() - 'x');
  }
  throw Error(fmt::format("{}: '{}' is not an axis: x, y, z, -x, -y or -z", what, printable(name)));
}

Eigen::Matrix3d sensor_axes(std::string_view text) {
  const auto parts = parts_between_commas(text);
  constexpr const char* kWhat = "the sensor's axes";
  if (parts.size() == 4) {
    Eigen::Vector4d q;
    for (int i = 0; i < 4; ++i) {
      const auto value = parse_double(parts[static_cast<std::size_t>(i)]);
      if (!value || !std::isfinite(*value)) {
        throw Error(fmt::format("{}: '{}' is not a quaternion qw,qx,qy,qz", kWhat, printable(text)));
      }
      q[i] = *value;
    }
    constexpr double kLeast = 0.5, kMost = 2.0;
    if (!(q.norm() > kLeast && q.norm() < kMost)) {
      throw Error(fmt::format("{}: '{}' is not a quaternion of length 1", kWhat, printable(text)));
    }
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  Eigen::Matrix3d out;
  if (parts.size() == 3) {
    for (int i = 0; i < 3; ++i) out.row(i) = axis_vector(parts[static_cast<std::size_t>(i)], kWhat).transpose();
    if (std::abs(std::abs(out.determinant()) - 1.0) < 0.5) return out;
  }
  throw Error(
      fmt::format("{}: '{}' is not three different axes, such as y,-x,z, or a quaternion", kWhat, printable(text)));
}

void mirror_poses(PoseStream& pose, std::string_view up) {
  const int axis = up == "z" || up == "-z" ? 1 : 2;
  for (Pose& T : pose.T_world_body) {
    T.translation_m[axis] = -T.translation_m[axis];
    // S R S with S = diag(1, 1, −1): the rotation vector's components across the mirrored axis change their sign.
    Eigen::Vector3d vector = -T.rotation.vec();
    vector[axis] = -vector[axis];
    T.rotation.vec() = vector;
  }
}

void turn_sensor(ImportStreams& streams, const Eigen::Matrix3d& axes) {
  if (axes.isIdentity(0.0)) return;
  const double sign = axes.determinant() < 0.0 ? -1.0 : 1.0;
  for (auto& f : streams.specific_force.value) f = axes * f;
  for (auto& omega : streams.rate.value) omega = sign * (axes * omega);
}

void turn_world(PoseStream& pose, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  if (up == z) return;
  const Eigen::Quaterniond turn = shortest_rotation(up, z);
  for (Pose& T : pose.T_world_body) {
    T.rotation = (turn * T.rotation).normalized();
    T.translation_m = turn * T.translation_m;
  }
}

std::optional<Eigen::Vector3d> mean_force_in_world(const ImportStreams& streams) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  PoseAt pose_at(streams.pose);
  for (std::size_t i = 0; i < streams.specific_force.size(); ++i) {
    const auto pose = pose_at.interpolate(streams.specific_force.t_ns[i]);
    if (!pose) continue;
    sum += pose->rotation * streams.specific_force.value[i];
    count += 1.0;
  }
  constexpr double kLeastSamples = 8.0;
  if (count < kLeastSamples) return std::nullopt;
  return Eigen::Vector3d(sum / count);
}

}  // namespace asperity
