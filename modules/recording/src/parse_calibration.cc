#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "asperity/json/parse_json.h"
#include "asperity/recording/parse_recording.h"
#include "calibration_parts.h"
#include "json_eigen.h"
#include "json_limits.h"
#include "known_extra.h"

namespace asperity {

namespace {

constexpr std::size_t kMostMarkers = 10'000;
constexpr Range kNotNegative{0.0, 1e9};
constexpr Range kOnProbe_m{-10.0, 10.0};  // a place on a hand-held probe, generously
constexpr Range kLatency_s{-1.0, 1.0};    // beyond, the streams are of different clocks
constexpr Range kTrackerSigma_m{0.0, 1.0};
constexpr Range kTrackerSigma_rad{0.0, 3.2};
constexpr Range kNewtonPerCount{-1e6, 1e6};
constexpr Range kForceOffset_N{-1e4, 1e4};  // an unsigned converter's zero: half of the range, of any hand's force
// Sensitivities from a shock sensor of 8 bits (1e-3) to micro-units (1e6), and a thousand times beyond.
constexpr double kLeastSensitivity = 1e-6, kMostSensitivity = 1e9;
// The zero of an unsigned converter is in the middle of the range: the widest are 2e5 m/s² and 1e2 rad/s.
constexpr double kMostZero_mps2 = 1e6, kMostZero_radps = 1e3;

// Far below any usable sensor: such a matrix would turn noise into signal.
constexpr double kLeastRelativeSingularValue = 1e-9;
// No maker gives the axes of one gyroscope sensitivities that differ by more.
constexpr double kLeastPlausibleRatio = 1e-2;

void require_invertible(const JsonObject& object, const Eigen::Matrix3d& B) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B);
  const auto& values = svd.singularValues();
  if (!(values[2] > kLeastRelativeSingularValue * values[0])) object.fail("B", "its linear part is singular");
  if (!(values[0] <= kMostSensitivity && values[2] >= kLeastSensitivity)) {
    object.fail("B",
                fmt::format("a sensitivity of {:.3g} counts a unit is not plausible: {:.0e} to {:.0e}",
                            values[0] > kMostSensitivity ? values[0] : values[2], kLeastSensitivity, kMostSensitivity));
  }
}

// A rate along a dull axis is nearly all noise, and turns the probe by it.
void require_even_axes(const JsonObject& object, const Eigen::Matrix3d& B) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B);
  const auto& values = svd.singularValues();
  if (!(values[2] >= kLeastPlausibleRatio * values[0])) {
    object.fail("B", fmt::format("sensitivities from {:.3g} to {:.3g} counts a unit in one sensor are not plausible",
                                 values[2], values[0]));
  }
}

// The reading at rest, as the sensor's quantity.
void require_plausible_zero(const JsonObject& object, const Eigen::Matrix3d& B, const Eigen::Vector3d& C, double most,
                            const char* unit) {
  const double zero = B.inverse().lazyProduct(C).cwiseAbs().maxCoeff();
  if (zero <= most) return;
  Eigen::Index axis = 0;
  const double worst = C.cwiseAbs().maxCoeff(&axis);
  object.fail("C", fmt::format("an offset of {:.3g} counts in axis {} stands for {:.3g} {}, at most {:.0e} {} is "
                               "plausible",
                               std::copysign(worst, C[axis]), axis, zero, unit, most, unit));
}

std::optional<Eigen::Vector3d> optional_vector(JsonObject& object, const std::string& key, Range range) {
  if (!object.has(key)) return std::nullopt;
  Eigen::Vector3d out;
  read_vector(object, key, out, range);
  return out;
}

AccelerometerCalibration read_accelerometer(JsonObject object) {
  AccelerometerCalibration out;
  const std::string model = object.required("model").text();
  if (model == "scalar_offset") {
    out.model = AccelerometerModel::kScalarOffset;
  } else if (model == "linear") {
    out.model = AccelerometerModel::kLinear;
  } else if (model == "quadric") {
    out.model = AccelerometerModel::kQuadric;
  } else {
    object.fail("model", fmt::format("'{}' is not scalar_offset, linear or quadric", model));
  }
  const std::size_t width = out.model == AccelerometerModel::kQuadric ? 9 : 3;
  object.required("B");
  read_matrix(object, "B", out.B, width);
  require_invertible(object, out.B.leftCols<3>());
  object.required("C").numbers(out.C.data(), 3);
  require_plausible_zero(object, out.B.leftCols<3>(), out.C, kMostZero_mps2, "m/s²");
  read_vector(object, "residual_counts", out.residual_counts, kNotNegative);
  read_matrix(object, "stderr", out.standard_errors, width + 1);
  object.read_bool("rotation_known", out.rotation_known);
  out.position_in_marker_m = optional_vector(object, "position_in_marker_m", kOnProbe_m);
  object.finish();
  return out;
}

GyroscopeCalibration read_gyroscope(JsonObject object) {
  GyroscopeCalibration out;
  Eigen::Matrix<double, 3, Eigen::Dynamic> B;
  object.required("B");
  read_matrix(object, "B", B, 3);
  out.B = B;
  require_invertible(object, out.B);
  require_even_axes(object, out.B);
  object.required("C").numbers(out.C.data(), 3);
  require_plausible_zero(object, out.B, out.C, kMostZero_radps, "rad/s");
  object.finish();
  return out;
}

ForceCalibration read_force(JsonObject object) {
  ForceCalibration out;
  out.newton_per_count = object.required("newton_per_count").number(kNewtonPerCount);
  object.read_number("offset_newton", out.offset_newton, kForceOffset_N);
  object.read_number("residual_newton", out.residual_newton, kNotNegative);
  out.axis_in_marker = optional_vector(object, "axis_in_marker", {});
  if (out.axis_in_marker && !(out.axis_in_marker->norm() > 0.0)) object.fail("axis_in_marker", "has no direction");
  object.finish();
  return out;
}

TrackerCalibration read_tracker(JsonObject object) {
  TrackerCalibration out;
  read_vector(object, "sigma_position_m", out.sigma_position_m, kTrackerSigma_m);
  read_vector(object, "sigma_rotation_rad", out.sigma_rotation_rad, kTrackerSigma_rad);
  object.read_number("latency_s", out.latency_s, kLatency_s);
  object.read_number("latency_sigma_s", out.latency_sigma_s, {0.0, 1.0});
  object.finish();
  return out;
}

}  // namespace

Calibration parse_calibration(std::string_view text, const std::string& name, const ReadLimits& limits,
                              const Observer& observer) {
  const Json root = parse_json(text, name, json_limits(limits), observer.without_progress());
  JsonObject object(root, name);
  object.require_format("asperity-calibration");
  Calibration out;
  out.accelerometer = read_accelerometer(object.required_object("accelerometer"));
  if (auto gyroscope = object.optional_object("gyroscope")) out.gyroscope = read_gyroscope(*gyroscope);
  out.force = read_force(object.required_object("force"));
  object.required("tip_in_marker_m").numbers(out.tip_in_marker_m.data(), 3, kOnProbe_m);
  object.read_number("tip_radius_m", out.tip_radius_m, {0.0, 0.1});
  if (auto tracker = object.optional_object("tracker")) out.tracker = read_tracker(*tracker);
  if (auto camera = object.optional_object("camera")) out.camera = read_camera_object(*camera);
  if (const auto markers = object.optional("markers")) {
    for (JsonItem& marker : markers->elements(kMostMarkers)) {
      out.markers.push_back(read_marker_object(JsonObject(std::move(marker))));
    }
  }
  if (auto extra = object.optional_object("extra")) {
    Json rest = root.at("extra");
    const auto take = [&](const std::string& key, double& value, Range range) {
      extra->read_number(key, value, range);
      rest.erase(key);
    };
    take("accelerometer_position_sigma_m", out.accelerometer.position_sigma_m, {0.0, 1.0});
    take("accelerometer_rotation_sigma_rad", out.accelerometer.rotation_sigma_rad, {0.0, 4.0});
    take("probe_latency_s", out.probe_latency_s, kLatency_s);
    take("probe_latency_sigma_s", out.probe_latency_sigma_s, {0.0, 1.0});
    const auto take3 = [&](const std::string& key, std::optional<Eigen::Vector3d>& value, Range range) {
      value = optional_vector(*extra, key, range);
      rest.erase(key);
    };
    take3("tip_sigma_m", out.tip_sigma_m, {0.0, 1.0});
    take3("tracker_slow_sigma_m", out.tracker.slow_sigma_m, {0.0, 1.0});
    if (extra->has("tracker_slow_time_s"))
      take("tracker_slow_time_s", out.tracker.slow_time_s.emplace(1.0), {1e-3, 1e6});
    take_known_extra(rest, out);
    out.extra = std::move(rest);
  }
  object.finish();
  return out;
}

}  // namespace asperity
