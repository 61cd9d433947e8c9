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

namespace asperity {
namespace {

double median_or_nan(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : median(values);
}

// Names the image that the tracker cannot use.
std::optional<TrackedPose> push(BodyTracker& tracker, const CameraFrame& frame, const CameraSource& source,
                                std::size_t number) {
  try {
    return tracker.push(frame.image, frame.t_ns);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: image {}, t_ns {}: {}", source.name(), number, frame.t_ns, error.what()));
  }
}

// False if the tags' frame was found to be another while rows had gone before.
bool follow(CameraSource& source, BodyTracker& tracker, TrackedImages& out, const Observer& observer,
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
      if (auto pose = push(tracker, frame, source, out.frames)) out.poses.push_back(std::move(*pose));
      if (tracker.tag_frame_was_changed() != was_changed) return false;
    }
  } catch (const LinkLost&) {
  }
  return true;
}

void summarise(TrackedImages& out) {
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

void judge(TrackedImages& out) {
  constexpr double kHardlyAny = 0.1;         // of the frames
  constexpr double kLargeResidual_px = 0.5;  // sound calibrations leave a few hundredths
  constexpr double kOften = 0.2;
  const double found = out.frames == 0 ? 0.0 : static_cast<double>(out.poses.size()) / static_cast<double>(out.frames);
  out.verdict = fmt::format("the body was found in {} of {} images", out.poses.size(), out.frames);
  if (found < kHardlyAny) {
    out.trustworthy = false;
    out.verdict += ": check the markers' family, ids and size, the light and the focus";
  } else if (out.median_reprojection_px > kLargeResidual_px) {
    out.trustworthy = false;
    out.verdict +=
        fmt::format(", but its corners are off by {:.2f} px: the camera's calibration or the markers' places are wrong",
                    out.median_reprojection_px);
  } else if (static_cast<double>(out.ambiguous) > kOften * static_cast<double>(out.poses.size())) {
    out.trustworthy = false;
    out.verdict += fmt::format(
        ", but in {} of them the tags' plane could lie the other way as well: use tags in more than one plane, or "
        "nearer",
        out.ambiguous);
  }
}

}  // namespace

TrackedImages track_images(const std::function<std::unique_ptr<CameraSource>()>& open, const CameraCalibration& camera,
                           const std::vector<MarkerPlacement>& body, const TrackConfig& config,
                           const Observer& observer, std::size_t frames_expected) {
  TrackedImages out;
  BodyTracker tracker(camera, body, config);
  if (!follow(*open(), tracker, out, observer, frames_expected)) {
    TrackConfig settled = config;
    settled.find_tag_frame = false;
    BodyTracker again(camera, tracker.body(), settled);
    follow(*open(), again, out, observer, frames_expected);
  }
  out.body = tracker.body();
  out.problems = tracker.problems();
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const TrackedPose& a, const TrackedPose& b) { return a.sample.t_ns < b.sample.t_ns; });
  summarise(out);
  judge(out);
  return out;
}

std::string tracked_csv_header() {
  return "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,markers,reprojection_px,sigma_px_m,sigma_py_m,sigma_pz_m,sigma_rx_rad,"
         "sigma_ry_rad,sigma_rz_rad\n";
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
    out += '\n';
  }
  return out;
}

}  // namespace asperity
