#include "check_lengths.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include "axes_choice.h"
#include "check_rotation.h"
#include "pose_at.h"
#include "running_integral.h"

namespace asperity {

namespace {

constexpr std::int64_t kHalf_ns = 100'000'000;
constexpr double kSameWay = 0.7, kOtherAxesFit = 0.9;

// Changes of the way over two halves of 0.1 s, by the poses and by the accelerometer, at the same times.
struct WayChanges {
  std::vector<Eigen::Vector3d> by_pose, by_force;
};

double way_product(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double way_cosine(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  const double both = std::sqrt(way_product(a, a) * way_product(b, b));
  return both > 0.0 ? way_product(a, b) / both : 0.0;
}

// For a specific force of `axes` times the sensor's; without the mean in the world, which is gravity.
WayChanges way_changes(const ImportStreams& streams, const Eigen::Matrix3d& axes) {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> acceleration;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  PoseAt pose_at(streams.pose);
  for (std::size_t i = 0; i < streams.specific_force.size(); ++i) {
    const auto pose = pose_at.interpolate(streams.specific_force.t_ns[i]);
    if (!pose) continue;
    t_ns.push_back(streams.specific_force.t_ns[i]);
    acceleration.push_back(pose->rotation * (axes * streams.specific_force.value[i]));
    sum += acceleration.back();
  }
  constexpr std::size_t kLeastSamples = 8;
  WayChanges out;
  if (t_ns.size() < kLeastSamples) return out;
  for (auto& value : acceleration) value -= sum / static_cast<double>(t_ns.size());
  const RunningIntegral velocity(t_ns, acceleration);
  std::vector<Eigen::Vector3d> velocities;
  for (const std::int64_t t : t_ns) velocities.push_back(*velocity.to(t));
  const RunningIntegral way(t_ns, velocities);
  PoseAt before(streams.pose), at(streams.pose), after(streams.pose);
  for (std::int64_t t = t_ns.front() + kHalf_ns; t + kHalf_ns <= t_ns.back(); t += kHalf_ns) {
    const auto left = way.between(t - kHalf_ns, t), right = way.between(t, t + kHalf_ns);
    const auto a = before.interpolate(t - kHalf_ns), b = at.interpolate(t), c = after.interpolate(t + kHalf_ns);
    if (!left || !right || !a || !b || !c) continue;
    out.by_force.push_back(*right - *left);
    out.by_pose.push_back((c->translation_m - b->translation_m) - (b->translation_m - a->translation_m));
  }
  return out;
}

bool moves_enough(const WayChanges& changes) {
  constexpr std::size_t kLeast = 20;
  constexpr double kLeast_mps2 = 0.3, kHalf_s = static_cast<double>(kHalf_ns) * 1e-9;
  const auto count = static_cast<double>(changes.by_force.size());
  return changes.by_force.size() >= kLeast &&
         std::sqrt(way_product(changes.by_force, changes.by_force) / count) >= kLeast_mps2 * kHalf_s * kHalf_s;
}

struct BestAxes {
  AxesChoice choice;
  double cosine = 0.0;
};

template <class CosineOf>
BestAxes best_of(const CosineOf& cosine_of) {
  BestAxes best;
  for (const double determinant : {1.0, -1.0}) {
    for (const AxesChoice& choice : all_axes(determinant)) {
      if (const double value = cosine_of(choice); value > best.cosine) best = {choice, value};
    }
  }
  return best;
}

// The way's changes are linear in the sensor's axes: those of each axis put on each axis of the body serve all.
BestAxes best_sensor_axes(const ImportStreams& streams, const std::vector<Eigen::Vector3d>& by_pose) {
  std::array<std::array<std::vector<Eigen::Vector3d>, 3>, 3> part;  // [body's axis][sensor's axis]
  for (int body = 0; body < 3; ++body) {
    for (int sensor = 0; sensor < 3; ++sensor) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      axes(body, sensor) = 1.0;
      part[static_cast<std::size_t>(body)][static_cast<std::size_t>(sensor)] = way_changes(streams, axes).by_force;
    }
  }
  return best_of([&](const AxesChoice& choice) {
    std::vector<Eigen::Vector3d> sum(by_pose.size(), Eigen::Vector3d::Zero());
    for (std::size_t body = 0; body < 3; ++body) {
      const auto& of_axis = part[body][static_cast<std::size_t>(choice.axis[body])];
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += choice.sign[body] * of_axis[i];
    }
    return way_cosine(by_pose, sum);
  });
}

BestAxes best_world_axes(const WayChanges& changes) {
  return best_of([&](const AxesChoice& choice) {
    std::vector<Eigen::Vector3d> exchanged;
    for (const auto& way : changes.by_pose) exchanged.push_back(choice.R * way);
    return way_cosine(exchanged, changes.by_force);
  });
}

void explain_axes(const ImportStreams& streams, const WayChanges& changes, StreamChecks& out) {
  const BestAxes sensor = best_sensor_axes(streams, changes.by_pose);
  const BestAxes world = best_world_axes(changes);
  if (std::max(sensor.cosine, world.cosine) < kOtherAxesFit) return;
  const std::string seen = fmt::format("positions and accelerometer do not show the same motion (cosine {:.2f}); ",
                                       way_cosine(changes.by_pose, changes.by_force));
  // Where both explain it, as with all signs changed, the accelerometer is the likelier: some measure the reaction.
  constexpr double kClearlyBetter = 0.02;
  const bool is_sensor = sensor.cosine + kClearlyBetter > world.cosine;
  const std::string name = (is_sensor ? sensor : world).choice.name();
  ImportDoubt doubt{
      is_sensor ? ColumnGroup::kAcceleration : ColumnGroup::kPosition,
      is_sensor ? FileRole::kImu : FileRole::kPose,
      seen + fmt::format("they agree (cosine {:.2f}) if x, y, z are {} of the {}", (is_sensor ? sensor : world).cosine,
                         name, is_sensor ? "accelerometer" : "positions"),
      {},
      {},
      name};
  out.doubts.push_back(std::move(doubt));
}

}  // namespace

double length_cosine(const ImportStreams& streams, const Eigen::Matrix3d& axes) {
  const WayChanges changes = way_changes(streams, axes);
  return moves_enough(changes) ? way_cosine(changes.by_pose, changes.by_force) : 0.0;
}

bool check_lengths(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out) {
  const WayChanges changes = way_changes(streams, Eigen::Matrix3d::Identity());
  if (!moves_enough(changes)) return false;
  if (way_cosine(changes.by_pose, changes.by_force) < kSameWay) {
    explain_axes(streams, changes, out);
    return false;
  }
  constexpr double kTolerance = 2.0;
  out.scale = way_product(changes.by_pose, changes.by_force) / way_product(changes.by_force, changes.by_force);
  if (out.scale < kTolerance && out.scale > 1.0 / kTolerance) return true;
  const std::string unit = unit_for_ratio(units.position, Quantity::kLength, out.scale, 1.5);
  out.doubts.push_back({ColumnGroup::kPosition,
                        FileRole::kPose,
                        fmt::format("it moves {:.4g} times as far as the accelerometer shows{}", out.scale,
                                    unit.empty() ? std::string() : ": this looks like " + unit),
                        unit,
                        {},
                        {}});
  return true;
}

}  // namespace asperity
