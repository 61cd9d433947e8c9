// libasperity_vision.so: all that is OpenCV's.
#include <algorithm>
#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "asperity/base/version.h"
#include "asperity/vision/vision.h"

namespace asperity {

namespace {

// A view: OpenCV has none of constant pixels, and those of its functions that get it only read.
cv::Mat view_of(const GrayImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

// cv::Exception stays in here.
template <class Work>
auto in_opencv(const Work& work) {
  try {
    return work();
  } catch (const cv::Exception& error) {
    throw VisionError(error.what());
  }
}

Eigen::Vector2f to_eigen(const cv::Point2f& p) { return {p.x, p.y}; }

std::vector<Eigen::Vector2f> to_eigen(const std::vector<cv::Point2f>& points) {
  std::vector<Eigen::Vector2f> out;
  for (const cv::Point2f& p : points) out.push_back(to_eigen(p));
  return out;
}

std::vector<cv::Point2f> to_cv(const std::vector<Eigen::Vector2f>& points) {
  std::vector<cv::Point2f> out;
  for (const Eigen::Vector2f& p : points) out.emplace_back(p.x(), p.y());
  return out;
}

std::vector<cv::Point3f> to_cv(const std::vector<Eigen::Vector3f>& points) {
  std::vector<cv::Point3f> out;
  for (const Eigen::Vector3f& p : points) out.emplace_back(p.x(), p.y(), p.z());
  return out;
}

cv::Ptr<cv::aruco::Dictionary> opencvs_dictionary(int opencv_id) {
  return cv::aruco::getPredefinedDictionary(static_cast<cv::aruco::PREDEFINED_DICTIONARY_NAME>(opencv_id));
}

ArucoDictionary predefined_dictionary(int opencv_id) {
  return in_opencv([&] {
    const cv::Ptr<cv::aruco::Dictionary> theirs = opencvs_dictionary(opencv_id);
    ArucoDictionary out;
    out.bits = theirs->markerSize;
    out.correctable_bits = theirs->maxCorrectionBits;
    for (int id = 0; id < theirs->bytesList.rows; ++id) {
      const cv::Mat cells =
          cv::aruco::Dictionary::getBitsFromByteList(theirs->bytesList.rowRange(id, id + 1), out.bits);
      out.markers.emplace_back(cells.begin<unsigned char>(), cells.end<unsigned char>());
    }
    return out;
  });
}

class OpencvMarkerFinder final : public MarkerFinder {
 public:
  OpencvMarkerFinder(const ArucoDictionary& dictionary, const MarkerFinderConfig& config) {
    cv::Mat codes;
    for (const std::vector<std::uint8_t>& marker : dictionary.markers) {
      cv::Mat cells(dictionary.bits, dictionary.bits, CV_8UC1);
      std::copy(marker.begin(), marker.end(), cells.begin<unsigned char>());
      codes.push_back(cv::aruco::Dictionary::getByteListFromBits(cells));
    }
    dictionary_ = cv::makePtr<cv::aruco::Dictionary>(codes, dictionary.bits, config.allowed_wrong_bits);
    parameters_->minMarkerPerimeterRate = config.smallest_perimeter;
    parameters_->errorCorrectionRate = 1.0;
  }

  std::vector<FoundMarker> find(const GrayImage& image) const override {
    return in_opencv([&] {
      std::vector<std::vector<cv::Point2f>> corners;
      std::vector<int> ids;
      cv::aruco::detectMarkers(view_of(image), dictionary_, corners, ids, parameters_);
      std::vector<FoundMarker> out(ids.size());
      for (std::size_t i = 0; i < ids.size(); ++i) {
        out[i].id = ids[i];
        for (std::size_t k = 0; k < 4; ++k) out[i].corner_px[k] = to_eigen(corners[i][k]);
      }
      return out;
    });
  }

 private:
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_ = cv::aruco::DetectorParameters::create();
};

std::unique_ptr<MarkerFinder> make_marker_finder(const ArucoDictionary& dictionary, const MarkerFinderConfig& config) {
  return in_opencv([&] { return std::make_unique<OpencvMarkerFinder>(dictionary, config); });
}

CharucoCorners find_charuco(const GrayImage& image, const CharucoLayout& board) {
  return in_opencv([&] {
    const auto dictionary = opencvs_dictionary(board.dictionary);
    const auto pattern =
        cv::aruco::CharucoBoard::create(board.columns, board.rows, board.square_m, board.marker_m, dictionary);
    const cv::Mat view = view_of(image);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> marker_ids;
    std::vector<cv::Point2f> corners;
    CharucoCorners out;
    cv::aruco::detectMarkers(view, dictionary, markers, marker_ids);
    if (marker_ids.empty()) return out;
    cv::aruco::interpolateCornersCharuco(markers, marker_ids, view, pattern, corners, out.id);
    out.corner_px = to_eigen(corners);
    return out;
  });
}

std::vector<Eigen::Vector2f> find_checkerboard(const GrayImage& image, int columns, int rows, bool by_sectors) {
  return in_opencv([&] {
    const cv::Size size(columns, rows);
    std::vector<cv::Point2f> corners;
    const bool found = by_sectors
                           ? cv::findChessboardCornersSB(view_of(image), size, corners,
                                                         cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY)
                           : cv::findChessboardCorners(
                                 view_of(image), size, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
    if (!found) corners.clear();
    return to_eigen(corners);
  });
}

void refine_corners(const GrayImage& image, int half_window_px, std::vector<Eigen::Vector2f>& corners_px) {
  in_opencv([&] {
    std::vector<cv::Point2f> corners = to_cv(corners_px);
    const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4);
    cv::cornerSubPix(view_of(image), corners, {half_window_px, half_window_px}, {-1, -1}, stop);
    corners_px = to_eigen(corners);
  });
}

std::vector<PlanePose> to_poses(const std::vector<cv::Mat>& rotations, const std::vector<cv::Mat>& translations) {
  const auto vector = [](const cv::Mat& m) {
    return Eigen::Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2));
  };
  std::vector<PlanePose> out;
  for (std::size_t i = 0; i < rotations.size(); ++i) out.push_back({vector(rotations[i]), vector(translations[i])});
  return out;
}

std::vector<PlanePose> square_poses(double half_m, const std::array<Eigen::Vector2d, 4>& rays) {
  return in_opencv([&] {
    const std::vector<cv::Point3d> square{
        {-half_m, half_m, 0.0}, {half_m, half_m, 0.0}, {half_m, -half_m, 0.0}, {-half_m, -half_m, 0.0}};
    std::vector<cv::Point2d> seen;
    for (const Eigen::Vector2d& ray : rays) seen.emplace_back(ray.x(), ray.y());
    std::vector<cv::Mat> rotations, translations;
    cv::solvePnPGeneric(square, seen, cv::Matx33d::eye(), cv::noArray(), rotations, translations, false,
                        cv::SOLVEPNP_IPPE_SQUARE);
    return to_poses(rotations, translations);
  });
}

std::vector<PlanePose> plane_poses(const PlaneView& view, const std::array<double, 9>& c) {
  return in_opencv([&] {
    const cv::Mat matrix = (cv::Mat_<double>(3, 3) << c[0], 0.0, c[2], 0.0, c[1], c[3], 0.0, 0.0, 1.0);
    const cv::Mat distortion = (cv::Mat_<double>(5, 1) << c[4], c[5], c[6], c[7], c[8]);
    std::vector<cv::Mat> rotations, translations;
    cv::solvePnPGeneric(to_cv(view.p_plane_m), to_cv(view.seen_px), matrix, distortion, rotations, translations, false,
                        cv::SOLVEPNP_IPPE);
    return to_poses(rotations, translations);
  });
}

double start_focal_px(const std::vector<PlaneView>& views, int width, int height) {
  return in_opencv([&] {
    std::vector<std::vector<cv::Point3f>> board;
    std::vector<std::vector<cv::Point2f>> pixel;
    for (const PlaneView& view : views) {
      board.push_back(to_cv(view.p_plane_m));
      pixel.push_back(to_cv(view.seen_px));
    }
    return cv::initCameraMatrix2D(board, pixel, {width, height}).at<double>(0, 0);
  });
}

GrayImage blur(const GrayImage& image, const PixelBox& box, double sigma_px) {
  return in_opencv([&] {
    cv::Mat smooth;
    cv::GaussianBlur(view_of(image)(cv::Rect(box.left, box.top, box.width, box.height)), smooth, cv::Size(), sigma_px);
    GrayImage out{box.width, box.height, {}};
    out.pixels.assign(smooth.begin<unsigned char>(), smooth.end<unsigned char>());
    return out;
  });
}

}  // namespace

}  // namespace asperity

extern "C" const asperity::Vision* asperity_vision() {
  using namespace asperity;
  static const Vision table{
      kVersion,       __VERSION__,  predefined_dictionary, make_marker_finder, find_charuco, find_checkerboard,
      refine_corners, square_poses, plane_poses,           start_focal_px,     blur};
  return &table;
}
