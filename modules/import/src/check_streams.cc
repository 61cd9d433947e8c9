#include "asperity/import/check_streams.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include "asperity/base/units.h"
#include "check_lengths.h"
#include "check_rotation.h"
#include "pose_at.h"

namespace asperity {

namespace {

void check_times(const std::vector<std::int64_t>& t_ns, FileRole role, const std::string& unit, double least_Hz,
                 double most_Hz, StreamChecks& out) {
  if (t_ns.size() < 2) return;
  const double interval_s = static_cast<double>(median_interval_ns(t_ns)) * 1e-9;
  const double span_s = static_cast<double>(t_ns.back() - t_ns.front()) * 1e-9;
  const double rate_Hz = 1.0 / interval_s;
  constexpr double kDay_s = 86400.0;
  if (rate_Hz >= least_Hz && rate_Hz <= most_Hz && span_s <= kDay_s) return;
  std::string unit_that_fits;
  for (const char* other : {"s", "ms", "us", "ns"}) {
    const auto is = find_import_unit(unit, Quantity::kTime), may_be = find_import_unit(other, Quantity::kTime);
    if (!is || is->is_date) break;
    const double scale = may_be->factor / is->factor;
    const double rate = rate_Hz / scale;
    if (scale != 1.0 && rate >= least_Hz && rate <= most_Hz && span_s * scale <= kDay_s) {
      unit_that_fits = other;
      break;
    }
  }
  out.doubts.push_back({ColumnGroup::kTime,
                        role,
                        fmt::format("the rows come at {:.4g} Hz over {:.4g} s{}", rate_Hz, span_s,
                                    unit_that_fits.empty() ? std::string() : ": this looks like " + unit_that_fits),
                        unit_that_fits,
                        {}});
}

// The mean over the quietest 0.4 s; nullopt if it varies by more than 4 % there.
std::optional<Eigen::Vector3d> force_at_rest(const VectorStream& force) {
  constexpr std::int64_t kWindow_ns = 400'000'000;
  constexpr std::size_t kLeastSamples = 8;
  constexpr double kStill = 0.04;
  std::optional<Eigen::Vector3d> best;
  double least = kStill;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t begin = 0;
  for (std::size_t end = 0; end < force.size(); ++end) {
    sum += force.value[end];
    if (force.t_ns[end] - force.t_ns[begin] < kWindow_ns) continue;
    // Windows that overlap by half, each summed by itself: linear, and without a running sum's rounding.
    const std::size_t count = end - begin + 1;
    const Eigen::Vector3d mean = sum / static_cast<double>(count);
    double square = 0.0;
    for (std::size_t i = begin; i <= end; ++i) square += (force.value[i] - mean).squaredNorm();
    const double spread = std::sqrt(square / static_cast<double>(count)) / std::max(mean.norm(), 1e-30);
    if (count >= kLeastSamples && spread < least) {
      least = spread;
      best = mean;
    }
    begin += std::max<std::size_t>(count / 2, 1);
    sum.setZero();
    for (std::size_t i = begin; i <= end; ++i) sum += force.value[i];
  }
  return best;
}

void check_gravity(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out) {
  if (streams.specific_force.size() == 0) return;
  constexpr double kAtRest = 1.03, kOnAverage = 1.1;
  double tolerance = kAtRest;
  std::string where = "while stationary";
  if (const auto rest = force_at_rest(streams.specific_force)) {
    out.rest_mps2 = rest->norm();
  } else if (const auto mean = mean_force_in_world(streams)) {
    out.rest_mps2 = mean->norm();
    tolerance = kOnAverage;
    where = "on average in the world";
  } else {
    out.notes.push_back(
        "specific force: its unit is not checked, because no interval is stationary and no pose belongs to it");
    return;
  }
  const double ratio = out.rest_mps2 / kStandardGravity_mps2;
  if (ratio < tolerance && ratio > 1.0 / tolerance) return;
  ImportDoubt doubt{ColumnGroup::kAcceleration, FileRole::kImu, {}, {}, {}};
  const auto read = find_import_unit(units.acceleration, Quantity::kAcceleration);
  const double in_file = read ? out.rest_mps2 / read->factor : out.rest_mps2;
  const std::string seen =
      fmt::format("{} it is {:.4g} ({:.4g} m/s²) where gravity is 9.81 m/s²", where, in_file, out.rest_mps2);
  constexpr double kGravityGone = 0.15, kManyCounts = 30.0;
  doubt.unit = unit_for_ratio(units.acceleration, Quantity::kAcceleration, ratio, 1.05);
  if (!doubt.unit.empty()) {
    doubt.message = seen + ": this looks like " + doubt.unit;
  } else if (ratio < kGravityGone) {
    doubt.message =
        seen + ": gravity has been taken out; the acceleration with gravity is needed, as the sensor gives it";
  } else if (in_file > kManyCounts) {
    doubt.message = seen + fmt::format(": this looks like counts; state their scale, about 1/{:.0f} g", in_file);
  } else {
    doubt.message = seen;
  }
  out.doubts.push_back(std::move(doubt));
}

void check_speed(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out) {
  const PoseStream& pose = streams.pose;
  constexpr std::int64_t kStretch_ns = 100'000'000;
  std::vector<double> speeds;
  std::size_t from = 0;
  for (std::size_t i = 1; i < pose.size(); ++i) {
    const std::int64_t length_ns = pose.t_ns[i] - pose.t_ns[from];
    if (length_ns < kStretch_ns) continue;
    speeds.push_back((pose.T_world_body[i].translation_m - pose.T_world_body[from].translation_m).norm() /
                     (static_cast<double>(length_ns) * 1e-9));
    from = i;
  }
  if (speeds.empty()) return;
  const auto high = speeds.begin() + static_cast<std::ptrdiff_t>((speeds.size() - 1) * 9 / 10);
  std::nth_element(speeds.begin(), high, speeds.end());
  constexpr double kFast_mps = 20.0;
  if (*high <= kFast_mps) return;
  const bool millimetres = units.position == "m" && *high * 1e-3 < kFast_mps;
  out.doubts.push_back({ColumnGroup::kPosition,
                        FileRole::kPose,
                        fmt::format("it moves at {:.4g} m/s{}", *high, millimetres ? ": this looks like mm" : ""),
                        millimetres ? "mm" : "",
                        {}});
}

}  // namespace

StreamChecks check_times_only(const ImportStreams& streams, const StreamUnits& units) {
  StreamChecks out;
  constexpr double kLeastPose_Hz = 2.0, kMostPose_Hz = 2e4, kLeastImu_Hz = 5.0, kMostImu_Hz = 6e4;
  check_times(streams.pose.t_ns, FileRole::kPose, units.pose_time, kLeastPose_Hz, kMostPose_Hz, out);
  check_times(streams.specific_force.t_ns, FileRole::kImu, units.imu_time, kLeastImu_Hz, kMostImu_Hz, out);
  return out;
}

StreamChecks check_streams(const ImportStreams& streams, const StreamUnits& units) {
  StreamChecks out = check_times_only(streams, units);
  if (!out.doubts.empty()) return out;  // the rest would compare what is not of one time
  check_gravity(streams, units, out);
  check_rotation(streams, units, out);
  // Positions are compared with an accelerometer whose unit and axes fit.
  if (!out.doubts.empty() || !check_lengths(streams, units, out)) {
    out.notes.push_back("positions: their unit is checked by the speed alone");
    check_speed(streams, units, out);
  }
  return out;
}

std::optional<UpAxis> estimate_up(const ImportStreams& streams) {
  const auto mean = mean_force_in_world(streams);
  if (!mean || !(mean->norm() > 0.0)) return std::nullopt;
  UpAxis out;
  out.direction = mean->normalized();
  int axis = 0;
  out.direction.cwiseAbs().maxCoeff(&axis);
  const bool negative = out.direction[axis] < 0.0;
  out.name = std::string(negative ? "-" : "") + "xyz"[axis];
  out.angle_rad = std::acos(std::min(std::abs(out.direction[axis]), 1.0));
  return out;
}

}  // namespace asperity
