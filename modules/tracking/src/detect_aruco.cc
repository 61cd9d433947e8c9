#include "asperity/tracking/detect_aruco.h"

#include <algorithm>
#include <cmath>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>

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

cv::Ptr<cv::aruco::Dictionary> to_opencv(const ArucoDictionary& dictionary, double false_alarms) {
  cv::Mat codes;
  for (const std::vector<std::uint8_t>& marker : dictionary.markers) {
    cv::Mat cells(dictionary.bits, dictionary.bits, CV_8UC1);
    std::copy(marker.begin(), marker.end(), cells.begin<unsigned char>());
    codes.push_back(cv::aruco::Dictionary::getByteListFromBits(cells));
  }
  return cv::makePtr<cv::aruco::Dictionary>(codes, dictionary.bits, allowed_wrong_bits(dictionary, false_alarms));
}

}  // namespace

struct ArucoDetector::Impl {
  int bits = 0;
  cv::Ptr<cv::aruco::Dictionary> dictionary;
  cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
};

ArucoDetector::ArucoDetector(const ArucoDictionary& dictionary, const ArucoConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->bits = dictionary.bits;
  impl_->dictionary = to_opencv(dictionary, config.false_alarms);
  impl_->parameters->minMarkerPerimeterRate = config.smallest_perimeter;
  impl_->parameters->errorCorrectionRate = 1.0;
}

ArucoDetector::~ArucoDetector() = default;

std::vector<TagDetection> ArucoDetector::detect(const GrayImage& image) const {
  if (image.width < 16 || image.height < 16) return {};
  const cv::Mat view(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(view, impl_->dictionary, corners, ids, impl_->parameters);
  std::vector<TagDetection> out(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    out[i].id = ids[i];
    double perimeter_px = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      out[i].corners_px.col(static_cast<Eigen::Index>(k)) << corners[i][k].x, corners[i][k].y;
      perimeter_px += cv::norm(corners[i][k] - corners[i][(k + 1) % 4]);
    }
    refine_quad(image, perimeter_px / 4.0 / (impl_->bits + 2), out[i].corners_px);
  }
  std::stable_sort(out.begin(), out.end(), [](const TagDetection& a, const TagDetection& b) { return a.id < b.id; });
  return out;
}

}  // namespace asperity
