#include "asperity/tracking/track_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/recording/camera_model.h"
#include "asperity/vision/vision.h"
#include "tag_search.h"

namespace asperity {
namespace {

struct TimedPose {
  std::int64_t t_ns = 0;
  Pose pose;
};

}  // namespace

struct BodyTracker::Impl {
  Impl(CameraCalibration of, std::vector<MarkerPlacement> tags, const TrackConfig& settings)
      : camera(std::move(of)), body(std::move(tags)), config(settings), search(camera, body, config) {
    vision();  // a missing library is told of now, and no frame waits for its loading
  }

  CameraCalibration camera;
  std::vector<MarkerPlacement> body;
  TrackConfig config;
  TagSearch search;
  TrackingStatistics statistics;
  Problems problems;
  std::vector<TimedPose> last;                // at most two, the newest at the end
  std::vector<std::vector<SeenTag>> misfits;  // frames that speak against the tag frame declared
  int unclear = 0;                            // frames of two tags or more that fit in no way
  bool frame_settled = false;
  bool frame_changed = false;

  std::optional<Pose> predict(std::int64_t t_ns) const;
  std::optional<ImageRegion> expected_region(const Pose& pose) const;
  std::optional<TrackedPose> solve(const std::vector<FoundTag>& found, const std::optional<Pose>& predicted,
                                   std::int64_t t_ns);
  bool settle_tag_frame(const std::vector<FoundTag>& found);
  bool is_leap(const Pose& pose, std::int64_t t_ns) const;
};

// Constant velocity from the last two poses.
std::optional<Pose> BodyTracker::Impl::predict(std::int64_t t_ns) const {
  if (last.empty()) return std::nullopt;
  const TimedPose& newest = last.back();
  const double ahead_s = static_cast<double>(t_ns - newest.t_ns) * kNanosecond_s;
  if (ahead_s < 0.0 || ahead_s > config.longest_gap_s) return std::nullopt;
  if (last.size() < 2) return newest.pose;
  const double step_s = static_cast<double>(newest.t_ns - last.front().t_ns) * kNanosecond_s;
  if (step_s <= 0.0 || step_s > config.longest_gap_s) return newest.pose;
  // A velocity from two noisy poses is not worth more than this far.
  constexpr double kFarthest = 3.0;
  const double share = std::min(kFarthest, ahead_s / step_s);
  const Pose& a = last.front().pose;
  const Pose& b = newest.pose;
  return Pose{exp_rotation(share * log_rotation(b.rotation * a.rotation.conjugate())) * b.rotation,
              b.translation_m + share * (b.translation_m - a.translation_m)};
}

std::optional<ImageRegion> BodyTracker::Impl::expected_region(const Pose& pose) const {
  Eigen::AlignedBox2d box;
  for (const MarkerPlacement& marker : body) {
    const Eigen::Matrix<double, 3, 4> corners_m = tag_corners_m(marker);
    for (int i = 0; i < 4; ++i) {
      const auto pixel = project(camera, pose * corners_m.col(i));
      if (!pixel || !pixel->allFinite()) return std::nullopt;
      box.extend(*pixel);
    }
  }
  constexpr double kLeastMargin_px = 16.0;
  const double margin_px = std::max(kLeastMargin_px, config.region_margin * box.sizes().maxCoeff());
  const auto column = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(camera.width))); };
  const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(camera.height))); };
  const ImageRegion region{column(box.min().x() - margin_px), row(box.min().y() - margin_px),
                           column(box.max().x() + margin_px + 1.0), row(box.max().y() + margin_px + 1.0)};
  if (region.empty()) return std::nullopt;
  return region;
}

std::string say_found(const TagFrameFinding& finding) {
  const std::string off =
      fmt::format("their corners are then off by {:.2f} px instead of {:.1f} px; taken so for the whole run",
                  finding.error_px, finding.declared_error_px);
  if (finding.as_good.empty()) {
    return fmt::format("the markers' T_marker_tag fit the images only if the tag frame is {}: {}", finding.description,
                       off);
  }
  return fmt::format(
      "the markers' T_marker_tag do not fit the images in the tag frame declared; {} frames fit equally well and the "
      "images do not distinguish them; the most usual is {}: {}. The other{}: {}. If another one is meant, declare "
      "\"tag_frame\": \"opencv\" or \"opencv_upright\" in the markers' file, or rotate its T_marker_tag",
      finding.as_good.size() + 1, finding.description, off, finding.as_good.size() == 1 ? "" : "s",
      fmt::join(finding.as_good, "; "));
}

// True once the body's tag frame is known, or nothing speaks against it.
bool BodyTracker::Impl::settle_tag_frame(const std::vector<FoundTag>& found) {
  if (frame_settled || !config.find_tag_frame || body.size() < 2 || found.size() < 2) return true;
  constexpr std::size_t kFramesToBeSure = 3;
  std::vector<SeenTag> seen;
  for (const FoundTag& tag : found) seen.push_back(tag.seen);
  misfits.push_back(std::move(seen));
  const TagFrameFinding alone = find_tag_frame(camera, body, std::span(&misfits.back(), 1), config.pose);
  if (alone.determined && alone.as_declared) {
    misfits.clear();
    frame_settled = true;
    return true;
  }
  if (!alone.determined) {
    misfits.pop_back();
    // Tags that fit in no way are badly placed, or wrongly read: the declared frame is as good as any.
    constexpr int kMostUnclear = 5;
    if (++unclear >= kMostUnclear) frame_settled = true;
    return frame_settled;
  }
  if (misfits.size() >= kFramesToBeSure) {
    const TagFrameFinding finding = find_tag_frame(camera, body, misfits, config.pose);
    if (finding.determined && !finding.as_declared) {
      body = with_tag_frame(std::move(body), finding.R_frame_tag);
      frame_settled = frame_changed = true;
      misfits.clear();
      last.clear();
      problems.push_back({"tag_frame", say_found(finding)});
      return true;
    }
    frame_settled = true;
  }
  return frame_settled;
}

// Farther from the last pose than a hand can have moved it.
bool BodyTracker::Impl::is_leap(const Pose& pose, std::int64_t t_ns) const {
  if (last.empty()) return false;
  const double gap_s = static_cast<double>(t_ns - last.back().t_ns) * kNanosecond_s;
  if (gap_s < 0.0 || gap_s > config.longest_gap_s) return false;
  return (pose.translation_m - last.back().pose.translation_m).norm() > config.fastest_mps * gap_s ||
         rotation_between_rad(pose, last.back().pose) > config.fastest_radps * gap_s;
}

std::optional<TrackedPose> BodyTracker::Impl::solve(const std::vector<FoundTag>& found,
                                                    const std::optional<Pose>& predicted, std::int64_t t_ns) {
  if (found.empty()) return std::nullopt;
  std::vector<SeenTag> seen;
  for (const FoundTag& tag : found) seen.push_back(tag.seen);
  const auto solved = solve_body_pose(camera, body, seen, predicted, config.pose);
  if (!solved || solved->reprojection_px > config.largest_reprojection_px || solved->corners_used < 4)
    return std::nullopt;
  if (solved->tags_used < 2 && is_leap(solved->T_camera_marker, t_ns)) return std::nullopt;
  TrackedPose out;
  out.sample.t_ns = t_ns;
  out.sample.T_world_marker = solved->T_camera_marker;
  out.sample.markers = solved->tags_used;
  out.sample.reprojection_px = solved->reprojection_px;
  out.covariance = solved->covariance;
  out.noise = solved->noise;
  out.ambiguous = solved->ambiguous;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (solved->used[i]) out.tags.push_back(found[i].detection);
  }
  return out;
}

BodyTracker::BodyTracker(CameraCalibration camera, std::vector<MarkerPlacement> body, TrackConfig config) {
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) throw Error("track: the camera has no focal length");
  if (body.empty()) throw Error("track: the body has no tags");
  impl_ = std::make_unique<Impl>(std::move(camera), std::move(body), config);
}

BodyTracker::~BodyTracker() = default;
BodyTracker::BodyTracker(BodyTracker&&) noexcept = default;
BodyTracker& BodyTracker::operator=(BodyTracker&&) noexcept = default;

std::optional<TrackedPose> BodyTracker::push(const GrayImage& image, std::int64_t t_ns) {
  Impl& self = *impl_;
  if (image.width != self.camera.width || image.height != self.camera.height) {
    throw Error(fmt::format("the image is {}×{}, the camera was calibrated at {}×{}", image.width, image.height,
                            self.camera.width, self.camera.height));
  }
  ++self.statistics.frames;
  const std::optional<Pose> predicted = self.predict(t_ns);
  const std::optional<ImageRegion> region = predicted ? self.expected_region(*predicted) : std::nullopt;
  std::vector<FoundTag> found;
  std::optional<TrackedPose> out;
  const auto solve_found = [&] {
    if (self.settle_tag_frame(found)) out = self.solve(found, predicted, t_ns);
    return out.has_value();
  };
  bool solved = false;
  if (region) {
    self.search.find(image, *region, self.body, found);
    solved = solve_found();
  }
  if (!solved) {
    self.search.find_in_whole(image, self.body, found);
    solved = solve_found();
    if (solved) self.search.forget_band();
  }
  if (!solved && self.config.find_faint) {
    self.search.find_faint(image, self.body, found);
    solved = solve_found();
  }
  if (solved && self.config.refine.enabled && self.config.find_covered &&
      self.search.find_covered(image, self.body, out->sample.T_world_marker, found)) {
    if (auto better = self.solve(found, out->sample.T_world_marker, t_ns)) out = std::move(better);
  }
  if (!out) return std::nullopt;
  ++self.statistics.poses;
  if (self.last.size() == 2) self.last.erase(self.last.begin());
  self.last.push_back({t_ns, out->sample.T_world_marker});
  return out;
}

const TrackingStatistics& BodyTracker::statistics() const { return impl_->statistics; }
const std::vector<MarkerPlacement>& BodyTracker::body() const { return impl_->body; }
bool BodyTracker::tag_frame_was_changed() const { return impl_->frame_changed; }
const Problems& BodyTracker::problems() const { return impl_->problems; }

}  // namespace asperity
