#include "tag_search.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/recording/camera_model.h"

namespace asperity {

TagSearch::TagSearch(CameraCalibration camera, const std::vector<MarkerPlacement>& body, const TrackConfig& config)
    : camera_(std::move(camera)), config_(config), spreads_(body.size()) {
  for (const MarkerPlacement& marker : body) {
    auto family = std::find_if(families_.begin(), families_.end(),
                               [&](const Family& known) { return known.name == marker.family; });
    if (family == families_.end()) {
      families_.push_back({marker.family, make_tag_detector(marker.family, config.detector)});
      family = families_.end() - 1;
    }
    auto pattern = family->detector->pattern(marker.id);
    if (!pattern) throw Error(fmt::format("markers: {} has no tag {}", marker.family, marker.id));
    patterns_.push_back(std::move(*pattern));
  }
}

void TagSearch::find_in(const GrayImage& image, const ImageRegion& region, const std::vector<MarkerPlacement>& body,
                        const std::optional<GreyBand>& in, std::vector<FoundTag>& out) {
  out.clear();
  if (in) {
    const GrayImage view = stretch_band(image, region, *in);
    detect(view, whole(view), body, out);
    for (FoundTag& tag : out) {
      tag.detection.corners_px.colwise() += Eigen::Vector2d(region.left, region.top);
      tag.seen.corners_px = tag.detection.corners_px;
    }
  } else {
    detect(image, region, body, out);
  }
  if (config_.refine.enabled) refine(image, out);
}

void TagSearch::detect(const GrayImage& view, const ImageRegion& region, const std::vector<MarkerPlacement>& body,
                       std::vector<FoundTag>& out) const {
  std::vector<TagDetection> detections;
  for (const Family& family : families_) {
    detections.clear();
    family.detector->detect(view, region, detections);
    for (const TagDetection& detection : detections) {
      const auto placement = std::find_if(body.begin(), body.end(), [&](const MarkerPlacement& marker) {
        return marker.id == detection.id && marker.family == family.name;
      });
      if (placement == body.end()) continue;
      FoundTag found{detection, {}};
      found.seen.tag = static_cast<std::size_t>(placement - body.begin());
      found.seen.corners_px = detection.corners_px;
      out.push_back(found);
    }
  }
}

void TagSearch::find_faint(const GrayImage& image, const std::vector<MarkerPlacement>& body,
                           std::vector<FoundTag>& out) {
  out.clear();
  band_.reset();
  const std::vector<GreyBand> bands = grey_bands();
  // Where the body is away for long, one band an image has to do.
  constexpr int kMostInFull = 8;
  const bool in_full = faint_misses_ < kMostInFull;
  next_band_ = (next_band_ + 1) % bands.size();
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (!in_full && i != next_band_) continue;
    const GreyBand& one = bands[i];
    std::vector<FoundTag> found;
    find_in(image, whole(image), body, one, found);
    if (found.size() <= out.size()) continue;
    out = std::move(found);
    band_ = one;
  }
  faint_misses_ = out.empty() ? faint_misses_ + 1 : 0;
}

bool TagSearch::find_covered(const GrayImage& image, const std::vector<MarkerPlacement>& body,
                             const Pose& T_camera_marker, std::vector<FoundTag>& found) {
  constexpr double kLeastCosine = 0.35;   // of the angle between the line of sight and the tag's axis: 70°
  constexpr double kLeastContrast = 4.0;  // in residuals: a picture that is not there leaves one of about 0.5
  bool any = false;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (std::any_of(found.begin(), found.end(), [&](const FoundTag& tag) { return tag.seen.tag == i; })) continue;
    const Pose T_camera_tag = T_camera_marker * body[i].T_marker_tag;
    const Eigen::Vector3d axis = T_camera_tag.rotation * Eigen::Vector3d::UnitZ();
    if (!(axis.dot(T_camera_tag.translation_m) > kLeastCosine * T_camera_tag.translation_m.norm())) continue;
    const Eigen::Matrix<double, 3, 4> corners_m = tag_corners_m(body[i]);
    FoundTag tag;
    tag.detection.id = body[i].id;
    bool inside = true;
    for (int k = 0; k < 4 && inside; ++k) {
      const auto pixel = project(camera_, T_camera_marker * corners_m.col(k));
      inside = pixel && pixel->x() > 0.0 && pixel->y() > 0.0 && pixel->x() < image.width - 1.0 &&
               pixel->y() < image.height - 1.0;
      if (inside) tag.detection.corners_px.col(k) = *pixel;
    }
    if (!inside) continue;
    const auto refined = refine_corners(image, camera_, patterns_[i], tag.detection.corners_px,
                                        spreads_[found.front().seen.tag], config_.refine);
    if (!refined || !(refined->white - refined->black > kLeastContrast * refined->residual)) continue;
    spreads_[i] = refined->spread;
    tag.seen.tag = i;
    tag.seen.corners_px = tag.detection.corners_px = refined->corners_px;
    tag.seen.covariance_px2 = refined->covariance_px2;
    tag.seen.has_covariance = true;
    found.push_back(tag);
    any = true;
  }
  return any;
}

void TagSearch::refine(const GrayImage& image, std::vector<FoundTag>& found) {
  constexpr int kFewest = 400;  // of one tag
  RefineCornersConfig each = config_.refine;
  if (!found.empty()) {
    each.most_pixels =
        std::min(each.most_pixels, std::max(kFewest, config_.most_pixels / static_cast<int>(found.size())));
  }
  for (FoundTag& tag : found) {
    PointSpread& spread = spreads_[tag.seen.tag];
    const auto refined =
        refine_corners(image, camera_, patterns_[tag.seen.tag], tag.detection.corners_px, spread, each);
    spread = refined ? refined->spread : PointSpread{};
    if (!refined) continue;
    tag.seen.corners_px = tag.detection.corners_px = refined->corners_px;
    tag.seen.covariance_px2 = refined->covariance_px2;
    tag.seen.has_covariance = true;
  }
}

}  // namespace asperity
