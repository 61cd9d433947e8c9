#include "asperity/tracking/track_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/statistics.h"
#include "asperity/transport/byte_source.h"
#include "asperity/verdict/verdict_codes.h"

namespace asperity {
namespace {

double median_or_nan(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : median(values);
}

// Names the image that the tracker cannot use.
std::optional<TrackedPose> push_frame(BodyTracker& tracker, const CameraFrame& frame, const CameraSource& source,
                                      std::size_t number) {
  try {
    return tracker.push(frame.image, frame.t_ns);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: image {}, t_ns {}: {}", source.name(), number, frame.t_ns, error.what()));
  }
}

// False if the tags' frame was found to be another while rows had gone before.
bool follow_source(CameraSource& source, BodyTracker& tracker, TrackedImages& out, const Observer& observer,
                   std::size_t frames_expected) {
  const bool was_changed = tracker.tag_frame_was_changed();
  CameraFrame frame;
  out.frames = 0;
  out.poses.clear();
  try {
    for (;;) {
      observer.update("tracking", frames_expected == 0 ? 0.0
                                                       : std::min(1.0, static_cast<double>(out.frames) /
                                                                           static_cast<double>(frames_expected)));
      if (!source.read(frame, std::chrono::milliseconds(1000))) continue;
      ++out.frames;
      if (auto pose = push_frame(tracker, frame, source, out.frames)) out.poses.push_back(std::move(*pose));
      if (tracker.tag_frame_was_changed() != was_changed) return false;
    }
  } catch (const LinkLost&) {
  }
  return true;
}

void summarise_poses(TrackedImages& out) {
  std::vector<double> reprojection;
  std::array<std::vector<double>, 6> sigma;
  for (const TrackedPose& pose : out.poses) {
    reprojection.push_back(pose.sample.reprojection_px);
    for (int i = 0; i < 6; ++i) sigma[static_cast<std::size_t>(i)].push_back(std::sqrt(pose.covariance(i, i)));
    out.ambiguous += pose.ambiguous ? 1 : 0;
  }
  out.median_reprojection_px = median_or_nan(reprojection);
  for (int i = 0; i < 3; ++i) {
    out.median_sigma_m[i] = median_or_nan(sigma[static_cast<std::size_t>(i)]);
    out.median_sigma_rad[i] = median_or_nan(sigma[static_cast<std::size_t>(i + 3)]);
  }
}

void judge_tracking(const CameraCalibration& camera, const BodyPoseConfig& config, TrackedImages& out) {
  constexpr double kHardlyAny = 0.1;         // of the frames
  constexpr double kLargeResidual_px = 0.5;  // sound calibrations leave a few hundredths
  constexpr double kOften = 0.2;
  const double found = out.frames == 0 ? 0.0 : static_cast<double>(out.poses.size()) / static_cast<double>(out.frames);
  if (found < kHardlyAny) {
    out.verdicts.push_back(make_verdict(
        "body_hardly_found", fmt::format("the body was found in {} of {} images", out.poses.size(), out.frames)));
  }
  if (out.median_reprojection_px > kLargeResidual_px) {
    out.verdicts.push_back(make_verdict(
        "tags_misfit",
        fmt::format("the tags' corners are off by {:.2f} px in the median, and the sigmas are larger by it",
                    out.median_reprojection_px)));
  }
  if (static_cast<double>(out.ambiguous) > kOften * static_cast<double>(out.poses.size())) {
    out.verdicts.push_back(
        make_verdict("plane_ambiguous", fmt::format("in {} of {} poses the tags' plane could lie the other way as well",
                                                    out.ambiguous, out.poses.size())));
  }
  if (!camera.covariance) {
    out.verdicts.push_back(make_verdict(
        "camera_errors_assumed",
        fmt::format("the camera's calibration states no errors; the sigmas hold {:.2g} % of its focal length",
                    100.0 * config.focal_error)));
  }
  sort_verdicts(out.verdicts);
  out.trustworthy = is_trustworthy(out.verdicts);
  out.verdict = verdict_sentence(out.verdicts);
}

}  // namespace

TrackedImages track_images(const std::function<std::unique_ptr<CameraSource>()>& open, const CameraCalibration& camera,
                           const std::vector<MarkerPlacement>& body, const TrackConfig& config,
                           const Observer& observer, std::size_t frames_expected) {
  TrackedImages out;
  BodyTracker tracker(camera, body, config);
  if (!follow_source(*open(), tracker, out, observer, frames_expected)) {
    TrackConfig settled = config;
    settled.find_tag_frame = false;
    BodyTracker again(camera, tracker.body(), settled);
    follow_source(*open(), again, out, observer, frames_expected);
  }
  out.body = tracker.body();
  out.problems = tracker.problems();
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const TrackedPose& a, const TrackedPose& b) { return a.sample.t_ns < b.sample.t_ns; });
  summarise_poses(out);
  judge_tracking(camera, config.pose, out);
  return out;
}

std::string tracked_csv_header() {
  return "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,markers,reprojection_px,sigma_px_m,sigma_py_m,sigma_pz_m,sigma_rx_rad,"
         "sigma_ry_rad,sigma_rz_rad,noise_px_m,noise_py_m,noise_pz_m,noise_rx_rad,noise_ry_rad,noise_rz_rad\n";
}

std::string format_tracked_csv(const std::vector<TrackedPose>& poses) {
  std::string out = tracked_csv_header();
  const auto cell = [&](double value) {
    out += ',';
    if (!std::isnan(value)) append_number(out, value);
  };
  for (const TrackedPose& pose : poses) {
    append_number(out, pose.sample.t_ns);
    for (const double value : pose.sample.T_world_marker.translation_m) cell(value);
    const Eigen::Quaterniond& q = pose.sample.T_world_marker.rotation;
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) cell(value);
    out += ',';
    append_number(out, std::int64_t{pose.sample.markers});
    cell(pose.sample.reprojection_px);
    for (int i = 0; i < 6; ++i) cell(std::sqrt(pose.covariance(i, i)));
    for (int i = 0; i < 6; ++i) cell(std::sqrt(pose.noise(i, i)));
    out += '\n';
  }
  return out;
}

}  // namespace asperity
