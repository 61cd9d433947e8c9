#include "asperity/acquire/find_tag_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/recording/camera_model.h"
#include "asperity/recording/read_markers.h"

namespace asperity {
namespace {

constexpr double kLargest_px = 20.0;
constexpr double kFits_px = 1.0;
constexpr double kMuchBetter = 3.0;

// The eight rotations that map a square onto itself, first those that keep its face.
std::array<Eigen::Quaterniond, 8> square_symmetries() {
  const double h = std::sqrt(0.5);
  return {{{1.0, 0.0, 0.0, 0.0},
           {h, 0.0, 0.0, h},
           {0.0, 0.0, 0.0, 1.0},
           {h, 0.0, 0.0, -h},
           {0.0, 1.0, 0.0, 0.0},
           {0.0, h, h, 0.0},
           {0.0, 0.0, 1.0, 0.0},
           {0.0, h, -h, 0.0}}};
}

double mean_error_px(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                     std::span<const std::vector<SeenTag>> frames, const BodyPoseConfig& config) {
  double sum_px = 0.0;
  int corners = 0;
  for (const std::vector<SeenTag>& seen : frames) {
    if (seen.size() < 2) continue;
    const auto solved = solve_body_pose(camera, body, seen, {}, config);
    for (const SeenTag& tag : seen) {
      const Eigen::Matrix<double, 3, 4> p_marker_m = tag_corners_m(body[tag.tag]);
      for (int i = 0; i < 4; ++i, ++corners) {
        double miss_px = kLargest_px;
        if (solved) {
          const auto pixel = project(camera, solved->T_camera_marker * p_marker_m.col(i));
          if (pixel) miss_px = std::min(miss_px, (*pixel - tag.corners_px.col(i)).norm());
        }
        sum_px += miss_px;
      }
    }
  }
  return corners == 0 ? kLargest_px : sum_px / corners;
}

bool is_same(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) { return std::abs(a.dot(b)) > 0.99; }

std::string describe(const Eigen::Quaterniond& R, const std::string& family) {
  if (is_same(R, R_frame_tag(TagFrame::kOpenCv, family))) return "OpenCV's (x right, y up, z out of the tag)";
  const Eigen::Vector3d x = R * Eigen::Vector3d::UnitX();
  const bool out_of_tag = (R * Eigen::Vector3d::UnitZ()).z() < 0.0;
  const long turn = std::lround(std::atan2(x.y(), x.x()) * 2.0 / 3.14159265358979);
  return "turned by " + std::to_string(90 * ((turn + 4) % 4)) + " degrees in the tag's plane, with z " +
         (out_of_tag ? "out of the tag" : "into the tag");
}

}  // namespace

std::vector<MarkerPlacement> with_tag_frame(std::vector<MarkerPlacement> body, const Eigen::Quaterniond& R_frame_tag) {
  for (MarkerPlacement& marker : body) {
    marker.T_marker_tag.rotation = (marker.T_marker_tag.rotation * R_frame_tag).normalized();
  }
  return body;
}

TagFrameFinding find_tag_frame(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                               std::span<const std::vector<SeenTag>> frames, const BodyPoseConfig& config) {
  TagFrameFinding out;
  const std::array<Eigen::Quaterniond, 8> symmetries = square_symmetries();
  out.declared_error_px = mean_error_px(camera, body, frames, config);
  out.error_px = out.declared_error_px;
  if (body.empty()) return out;
  const std::string& family = body.front().family;
  out.description = "AprilTag's (x right, y down, z into the tag)";
  if (out.declared_error_px <= kFits_px) {
    out.determined = true;
    return out;
  }
  std::array<double, 8> error_px{};
  for (std::size_t i = 0; i < symmetries.size(); ++i) {
    error_px[i] = mean_error_px(camera, with_tag_frame(body, symmetries[i]), frames, config);
  }
  std::size_t best = static_cast<std::size_t>(std::min_element(error_px.begin(), error_px.end()) - error_px.begin());
  if (error_px[best] > kFits_px || error_px[best] * kMuchBetter > out.declared_error_px) return out;
  // Of several that fit alike, the usual one.
  const Eigen::Quaterniond usual = R_frame_tag(TagFrame::kOpenCv, family);
  for (std::size_t i = 0; i < symmetries.size(); ++i) {
    if (is_same(symmetries[i], usual) && error_px[i] < kMuchBetter * error_px[best]) best = i;
  }
  out.R_frame_tag = symmetries[best];
  out.as_declared = false;
  out.determined = true;
  out.error_px = error_px[best];
  out.description = describe(symmetries[best], family);
  return out;
}

}  // namespace asperity
