#include "asperity/tracking/find_tag_frame.h"

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
constexpr double kAlike_px = 0.1;  // what a sound fit leaves; less tells no frames apart

bool is_same(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) { return std::abs(a.dot(b)) > 0.99; }

// The eight rotations that map a square onto itself, the usual ones first: ours, OpenCV's on AprilTag's picture,
// OpenCV's on its own, then those that keep the face and those that do not.
std::vector<Eigen::Quaterniond> square_symmetries(const std::string& family) {
  const double h = std::sqrt(0.5);
  const std::array<Eigen::Quaterniond, 8> all{{{1.0, 0.0, 0.0, 0.0},
                                               {h, 0.0, 0.0, h},
                                               {0.0, 0.0, 0.0, 1.0},
                                               {h, 0.0, 0.0, -h},
                                               {0.0, 1.0, 0.0, 0.0},
                                               {0.0, h, h, 0.0},
                                               {0.0, 0.0, 1.0, 0.0},
                                               {0.0, h, -h, 0.0}}};
  std::vector<Eigen::Quaterniond> out{all[0], R_frame_tag(TagFrame::kOpenCvUpright, family)};
  const auto add = [&](const Eigen::Quaterniond& R) {
    if (std::none_of(out.begin(), out.end(), [&](const Eigen::Quaterniond& known) { return is_same(known, R); })) {
      out.push_back(R);
    }
  };
  add(R_frame_tag(TagFrame::kOpenCv, family));
  for (const Eigen::Quaterniond& R : all) add(R);
  return out;
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

std::string describe_frame(const Eigen::Quaterniond& R, const std::string& family) {
  if (is_same(R, R_frame_tag(TagFrame::kOpenCv, family))) {
    return "OpenCV's (x right, y up, z out of the tag, upright as OpenCV draws it)";
  }
  // The frame's axes as AprilTag's picture shows them.
  const auto toward = [&](const Eigen::Vector3d& axis) -> std::string {
    const Eigen::Vector3d v = R.conjugate() * axis;
    if (std::abs(v.x()) > 0.5) return v.x() > 0.0 ? "right" : "left";
    if (std::abs(v.y()) > 0.5) return v.y() > 0.0 ? "down" : "up";
    return v.z() > 0.0 ? "into the tag" : "out of the tag";
  };
  return "x " + toward(Eigen::Vector3d::UnitX()) + ", y " + toward(Eigen::Vector3d::UnitY()) + ", z " +
         toward(Eigen::Vector3d::UnitZ()) + ", upright as libapriltag draws it";
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
  out.declared_error_px = mean_error_px(camera, body, frames, config);
  out.error_px = out.declared_error_px;
  if (body.empty()) return out;
  const std::string& family = body.front().family;
  const std::vector<Eigen::Quaterniond> symmetries = square_symmetries(family);
  out.description = "AprilTag's (x right, y down, z into the tag)";
  if (out.declared_error_px <= kFits_px) {
    out.determined = true;
    return out;
  }
  std::vector<double> error_px;
  for (const Eigen::Quaterniond& R : symmetries) {
    error_px.push_back(mean_error_px(camera, with_tag_frame(body, R), frames, config));
  }
  const double least_px = *std::min_element(error_px.begin(), error_px.end());
  if (least_px > kFits_px || least_px * kMuchBetter > out.declared_error_px) return out;
  // Of several that fit alike, the most usual.
  const auto fits_alike = [&](double one_px) {
    return one_px <= std::min(kFits_px, std::max(kAlike_px, kMuchBetter * least_px));
  };
  const auto best =
      static_cast<std::size_t>(std::find_if(error_px.begin(), error_px.end(), fits_alike) - error_px.begin());
  for (std::size_t i = 0; i < symmetries.size(); ++i) {
    if (i != best && fits_alike(error_px[i])) out.as_good.push_back(describe_frame(symmetries[i], family));
  }
  out.R_frame_tag = symmetries[best];
  out.as_declared = false;
  out.determined = true;
  out.error_px = error_px[best];
  out.description = describe_frame(symmetries[best], family);
  return out;
}

}  // namespace asperity
