#include "asperity/tracking/detect_aruco.h"

#include <algorithm>
#include <cmath>

#include "asperity/vision/vision.h"
#include "refine_quad.h"

namespace asperity {

namespace {

// The most wrong cells, at most all that can be corrected, with which a square of random cells is taken for a marker
// by chance at most `false_alarms` of the time.
int allowed_wrong_bits(const ArucoDictionary& dictionary, double false_alarms) {
  const int cells = dictionary.bits * dictionary.bits;
  const double codes = 4.0 * static_cast<double>(dictionary.markers.size()) * std::exp2(-cells);
  double choices = 1.0, ball = 1.0;  // of cells that are wrong: exactly, and at most, `wrong`
  for (int wrong = 0; wrong < dictionary.correctable_bits; ++wrong) {
    choices *= static_cast<double>(cells - wrong) / static_cast<double>(wrong + 1);
    ball += choices;
    if (codes * ball > false_alarms) return wrong;
  }
  return dictionary.correctable_bits;
}

}  // namespace

struct ArucoDetector::Impl {
  int bits = 0;
  std::unique_ptr<MarkerFinder> finder;
};

ArucoDetector::ArucoDetector(const ArucoDictionary& dictionary, const ArucoConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->bits = dictionary.bits;
  impl_->finder = vision().make_marker_finder(
      dictionary, {allowed_wrong_bits(dictionary, config.false_alarms), config.smallest_perimeter});
}

ArucoDetector::~ArucoDetector() = default;

std::vector<TagDetection> ArucoDetector::detect(const GrayImage& image) const {
  if (image.width < 16 || image.height < 16) return {};
  std::vector<TagDetection> out;
  for (const auto& [id, corner_px] : impl_->finder->find(image)) {
    TagDetection& tag = out.emplace_back();
    tag.id = id;
    double perimeter_px = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      tag.corners_px.col(static_cast<Eigen::Index>(k)) = corner_px[k].cast<double>();
      perimeter_px += (corner_px[k] - corner_px[(k + 1) % 4]).cast<double>().norm();
    }
    refine_quad(image, perimeter_px / 4.0 / (impl_->bits + 2), tag.corners_px);
  }
  std::stable_sort(out.begin(), out.end(), [](const TagDetection& a, const TagDetection& b) { return a.id < b.id; });
  return out;
}

}  // namespace asperity
