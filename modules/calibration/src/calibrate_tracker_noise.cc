#include "asperity/calibration/calibrate_tracker_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/fingerprint.h"
#include "find_static_intervals.h"
#include "fit_noise_law.h"

namespace asperity {

namespace {

using Channel = std::array<SeriesNoise, 3>;

std::array<SeriesNoise, 3> fit_axes(const std::vector<double>& t_s, const std::vector<Eigen::Vector3d>& x) {
  Channel out;
  std::vector<double> values(x.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < x.size(); ++i) values[i] = x[i][axis];
    out[static_cast<std::size_t>(axis)] = fit_series_noise(t_s, values);
  }
  return out;
}

double robust_sigma(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  const double centre = *middle;
  for (double& value : x) value = std::abs(value - centre);
  std::nth_element(x.begin(), middle, x.end());
  return 1.4826 * *middle;
}

// The rows that are no outliers in any axis of either deviation.
std::vector<std::size_t> inlier_rows(const std::vector<Eigen::Vector3d>& position,
                                     const std::vector<Eigen::Vector3d>& rotation, double sigmas) {
  std::vector<bool> bad(position.size());
  for (const auto* series : {&position, &rotation}) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> x;
      for (const Eigen::Vector3d& value : *series) x.push_back(value[axis]);
      const double limit = sigmas * robust_sigma(x);
      for (std::size_t i = 0; i < x.size(); ++i) bad[i] = bad[i] || (limit > 0.0 && std::abs(x[i]) > limit);
    }
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    if (!bad[i]) out.push_back(i);
  }
  return out;
}

// The cosine between a tag's normal (into the tag) and the ray to its centre; the largest of all tags.
double facing(const StaticTracker& recording, const Pose& T_camera_marker) {
  double best = 0.0;
  const auto look = [&](const Pose& T_marker_tag) {
    const Pose T_camera_tag = T_camera_marker * T_marker_tag;
    const Eigen::Vector3d ray = T_camera_tag.translation_m.normalized();
    best = std::max(best, ray.dot(T_camera_tag.rotation * Eigen::Vector3d::UnitZ()));
  };
  for (const MarkerPlacement& marker : recording.markers) look(marker.T_marker_tag);
  if (!recording.markers.empty()) return best;
  // Which side of the marker frame's plane the print is on is not known.
  return std::abs(T_camera_marker.translation_m.normalized().dot(T_camera_marker.rotation * Eigen::Vector3d::UnitZ()));
}

StaticInterval measure_static_interval(const StaticTracker& recording, PoseRange range,
                                       const TrackerNoiseConfig& config) {
  const TrackerStream& tracker = *recording.tracker;
  StaticInterval rest;
  rest.recording = recording.name;
  rest.start_ns = tracker.t_ns[range.first];
  rest.end_ns = tracker.t_ns[range.last - 1];
  rest.T_world_marker.rotation = mean_rotation(tracker, range);
  std::vector<double> axis(range.last - range.first);
  for (int k = 0; k < 3; ++k) {  // the median first: an outlier must not move what it is measured from
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = tracker.T_world_marker[range.first + i].translation_m[k];
    std::nth_element(axis.begin(), axis.begin() + static_cast<std::ptrdiff_t>(axis.size() / 2), axis.end());
    rest.T_world_marker.translation_m[k] = axis[axis.size() / 2];
  }
  std::vector<Eigen::Vector3d> position, rotation;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Pose& pose = tracker.T_world_marker[i];
    position.push_back(pose.translation_m - rest.T_world_marker.translation_m);
    rotation.push_back(log_rotation(pose.rotation * rest.T_world_marker.rotation.conjugate()));
  }
  const std::vector<std::size_t> rows = inlier_rows(position, rotation, config.outlier_sigmas);
  rest.outliers = position.size() - rows.size();
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> turn;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t i : rows) {
    t_s.push_back(static_cast<double>(tracker.t_ns[range.first + i] - rest.start_ns) * kNanosecond_s);
    rest.deviation_m.push_back(position[i]);
    turn.push_back(rotation[i]);
    mean += position[i] / static_cast<double>(rows.size());
  }
  rest.T_world_marker.translation_m += mean;
  for (Eigen::Vector3d& deviation : rest.deviation_m) deviation -= mean;
  rest.position_m = fit_axes(t_s, rest.deviation_m);
  rest.rotation_rad = fit_axes(t_s, turn);
  if (!recording.world_is_camera || !(rest.T_world_marker.translation_m.norm() > 0.0)) return rest;

  rest.distance_m = rest.T_world_marker.translation_m.norm();
  rest.tilt_rad = std::acos(std::clamp(facing(recording, rest.T_world_marker), 0.0, 1.0));
  const Eigen::Matrix3d R_ray_world =
      shortest_rotation(rest.T_world_marker.translation_m, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Eigen::Vector3d> ray = rest.deviation_m;
  for (Eigen::Vector3d& deviation : ray) deviation = R_ray_world * deviation;
  for (Eigen::Vector3d& angle : turn) angle = R_ray_world * angle;
  rest.ray_position_m = fit_axes(t_s, ray);
  rest.ray_rotation_rad = fit_axes(t_s, turn);
  return rest;
}

// The root of the mean variance over rests, by their numbers of poses, and its standard error.
void pool_intervals(const std::vector<StaticInterval>& rests, Channel StaticInterval::*channel, Eigen::Vector3d& sigma,
                    Eigen::Vector3d& error, Eigen::Vector3d& slow) {
  for (int axis = 0; axis < 3; ++axis) {
    double count = 0.0, white2 = 0.0, variance = 0.0, slow2 = 0.0;
    for (const StaticInterval& rest : rests) count += static_cast<double>((rest.*channel)[0].samples);
    for (const StaticInterval& rest : rests) {
      const SeriesNoise& noise = (rest.*channel)[static_cast<std::size_t>(axis)];
      const double share = static_cast<double>(noise.samples) / count;
      white2 += share * noise.white * noise.white;
      slow2 += share * noise.slow * noise.slow;
      variance += std::pow(share * 2.0 * noise.white * noise.white_error, 2);
    }
    sigma[axis] = std::sqrt(white2);
    error[axis] = white2 > 0.0 ? std::sqrt(variance) / (2.0 * sigma[axis]) : 0.0;
    slow[axis] = std::sqrt(slow2);
  }
}

// Two axes of which neither is special: their mean variance.
NoiseAtPose noise_across(const StaticInterval& rest, const Channel& channel) {
  const double a = channel[0].white, b = channel[1].white;
  NoiseAtPose place{rest.distance_m, rest.tilt_rad, std::sqrt(0.5 * (a * a + b * b)), 0.0};
  place.sigma_error = std::hypot(a * channel[0].white_error, b * channel[1].white_error) / (2.0 * place.sigma);
  return place;
}

NoiseAtPose noise_along(const StaticInterval& rest, const Channel& channel) {
  return {rest.distance_m, rest.tilt_rad, channel[2].white, channel[2].white_error};
}

void fit_model(const TrackerNoiseConfig& config, TrackerNoise& out) {
  std::vector<NoiseAtPose> across, along, about, tilt;
  TrackerNoiseModel model;
  for (const StaticInterval& rest : out.rests) {
    const auto measured = [](const SeriesNoise& noise) {
      return noise.white > 0.0 && std::isfinite(noise.white_error);
    };
    if (!(rest.distance_m > 0.0) || !std::all_of(rest.ray_position_m.begin(), rest.ray_position_m.end(), measured) ||
        !std::all_of(rest.ray_rotation_rad.begin(), rest.ray_rotation_rad.end(), measured)) {
      continue;
    }
    across.push_back(noise_across(rest, rest.ray_position_m));
    along.push_back(noise_along(rest, rest.ray_position_m));
    tilt.push_back(noise_across(rest, rest.ray_rotation_rad));
    about.push_back(noise_along(rest, rest.ray_rotation_rad));
    model.nearest_m = across.size() == 1 ? rest.distance_m : std::min(model.nearest_m, rest.distance_m);
    model.farthest_m = std::max(model.farthest_m, rest.distance_m);
    model.steepest_rad = std::max(model.steepest_rad, rest.tilt_rad);
  }
  constexpr std::size_t kFewest = 4;
  if (across.size() < kFewest) {
    out.no_model_because = fmt::format(
        "{} usable static intervals with a camera, {} are needed: record the clamped probe at several distances and "
        "tilts",
        across.size(), kFewest);
    return;
  }
  if (!(model.farthest_m >= config.least_distance_ratio * model.nearest_m)) {
    out.no_model_because =
        fmt::format("all static intervals were {:.0f} to {:.0f} mm away: record some nearer or farther",
                    1e3 * model.nearest_m, 1e3 * model.farthest_m);
    return;
  }
  constexpr double kBroadside_rad = 1.5;  // beyond, no tag is seen and the cosine says nothing
  if (model.steepest_rad > kBroadside_rad) {
    out.no_model_because = "a tag was seen edge-on: the markers' places in calibration.json cannot be right";
    return;
  }
  model.across_m = fit_noise_law(across, 1.0, config.least_tilt_ratio);
  model.along_m = fit_noise_law(along, 2.0, config.least_tilt_ratio);
  model.about_rad = fit_noise_law(about, 1.0, config.least_tilt_ratio);
  model.tilt_rad = fit_noise_law(tilt, 2.0, config.least_tilt_ratio);
  out.model = model;
}

void judge_tracker_noise(TrackerNoise& out) {
  // Of hundreds of poses even a harmless departure from the Gaussian shows: it must also be large.
  constexpr double kProbability = 1e-3, kSkewness = 0.5, kKurtosis = 1.0;
  const SeriesNoise* worst = nullptr;
  const char* worst_name = "";
  for (const StaticInterval& rest : out.rests) {
    for (const auto& [name, channel] : {std::pair{"position", &rest.position_m}, {"rotation", &rest.rotation_rad}}) {
      for (const SeriesNoise& noise : *channel) {
        const bool large = std::abs(noise.skewness) > kSkewness || std::abs(noise.excess_kurtosis) > kKurtosis;
        if (!large || !(noise.gaussian_probability < kProbability)) continue;
        if (worst == nullptr || noise.gaussian_probability < worst->gaussian_probability) {
          worst = &noise;
          worst_name = name;
        }
      }
    }
  }
  out.gaussian = worst == nullptr;
  out.moving = (out.slow_position_m.array() > out.sigma_position_m.array()).any() ||
               (out.slow_rotation_rad.array() > out.sigma_rotation_rad.array()).any();
  const Eigen::Vector3d s = 1e3 * out.sigma_position_m;
  out.verdict.text = fmt::format("white noise of {:.3g}, {:.3g}, {:.3g} mm along x, y, z over {} static interval{}.",
                                 s.x(), s.y(), s.z(), out.rests.size(), out.rests.size() == 1 ? "" : "s");
  if (!(out.sigma_position_m.minCoeff() > 0.0) || !(out.sigma_rotation_rad.minCoeff() > 0.0)) {
    out.verdict.text.clear();
    out.verdict.add("no_noise",
                    "a coordinate did not change at all over a static interval: these poses were not measured");
    return;
  }
  if (out.gaussian) {
    out.verdict.text += " A Gaussian describes it.";
  } else {
    out.verdict.add(
        "noise_not_gaussian",
        fmt::format("it is not Gaussian ({}: skewness {:.2f}, excess kurtosis {:.1f}): flickering light, or "
                    "poses that flip",
                    worst_name, worst->skewness, worst->excess_kurtosis));
  }
  if (out.moving) {
    out.verdict.add("body_moved", fmt::format("the body moved: drift of {:.2g} mm and {:.2g} rad, more than the noise "
                                              "(a hand's tremor, changing light); the white noise is valid",
                                              1e3 * out.slow_position_m.maxCoeff(), out.slow_rotation_rad.maxCoeff()));
  } else if (out.slow_position_m.norm() > 0.0 || out.slow_rotation_rad.norm() > 0.0) {
    out.verdict.text +=
        fmt::format(" Drift of {:.2g} mm is not in these values.", 1e3 * out.slow_position_m.maxCoeff());
  }
}

}  // namespace

TrackerNoise calibrate_tracker_noise(std::span<const StaticTracker> recordings, const TrackerNoiseConfig& config) {
  std::vector<NamedFingerprint> measured_from;
  for (const StaticTracker& recording : recordings)
    measured_from.push_back({recording.name, {{}, sketch_poses(*recording.tracker), {}}});
  check_independent(measured_from);
  TrackerNoise out;
  double longest_s = 0.0;
  LongestRest rested;
  for (const StaticTracker& recording : recordings) {
    const TrackerStream& tracker = *recording.tracker;
    if (tracker.size() > 1) {
      longest_s = std::max(longest_s, static_cast<double>(tracker.t_ns.back() - tracker.t_ns.front()) * kNanosecond_s);
    }
    for (const PoseRange range : find_static_intervals(tracker, config, &rested)) {
      out.rests.push_back(measure_static_interval(recording, range, config));
      const StaticInterval& rest = out.rests.back();
      if (rest.outliers == 0) continue;
      out.problems.push_back(
          {"tracker_outlier",
           fmt::format("{}: {} of {} poses of a static interval are far from the others and were left out",
                       printable(recording.name), rest.outliers, range.last - range.first),
           rest.outliers});
    }
  }
  if (out.rests.empty()) {
    std::string why = fmt::format("the longest recording has {:.3g} s", longest_s);
    if (rested.moved_m > 0.0 || rested.rotated_rad > 0.0) {
      constexpr double kMilli = 1e3;
      why = fmt::format(
          "it was stationary for {:.3g} s at most, then it was {:.2g} mm and {:.2g} mrad away, where {:.3g} mm and "
          "{:.3g} mrad are allowed; a probe in a hand is not stationary",
          rested.length_s, kMilli * rested.moved_m, kMilli * rested.rotated_rad, kMilli * config.rest_position_m,
          kMilli * config.rest_rotation_rad);
    }
    throw Error(
        fmt::format("calibrate tracker: the marker was never stationary for {:.3g} s with {} poses ({}): clamp the "
                    "probe in front of the camera and record half a minute, then at other distances and tilts",
                    config.least_rest_s, config.least_poses, why));
  }
  pool_intervals(out.rests, &StaticInterval::position_m, out.sigma_position_m, out.sigma_position_error_m,
                 out.slow_position_m);
  pool_intervals(out.rests, &StaticInterval::rotation_rad, out.sigma_rotation_rad, out.sigma_rotation_error_rad,
                 out.slow_rotation_rad);
  fit_model(config, out);
  judge_tracker_noise(out);
  return out;
}

}  // namespace asperity
