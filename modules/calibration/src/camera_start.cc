#include "camera_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/vision/vision.h"

namespace asperity {

namespace {

PlaneView to_plane_view(const BoardView& view) {
  PlaneView out;
  for (std::size_t i = 0; i < view.corner_px.size(); ++i) {
    out.p_plane_m.push_back(view.p_board_m[i].cast<float>());
    out.seen_px.push_back(view.corner_px[i].cast<float>());
  }
  return out;
}

// Both poses in which the flat board looks nearly as it was seen, the better first.
std::vector<Pose> planar_poses(const PlaneView& view, const CameraVector& c) {
  std::vector<Pose> out;
  for (const auto& [rotation_rad, translation_m] :
       vision().plane_poses(view, {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]})) {
    out.push_back({exp_rotation(rotation_rad), translation_m});
  }
  return out;
}

double start_focal_px(const std::vector<PlaneView>& views, int width, int height) {
  const double f = vision().start_focal_px(views, width, height);
  const double side = std::max(width, height);
  // From 157 to 3 degrees across; beyond, the closed form was lost in noise.
  return f > 0.1 * side && f < 20.0 * side ? f : side;
}

}  // namespace

CameraBundle start_bundle(std::span<const BoardView* const> views, int width, int height) {
  try {
    std::vector<PlaneView> plane_views;
    for (const BoardView* view : views) plane_views.push_back(to_plane_view(*view));
    const double f = start_focal_px(plane_views, width, height);
    CameraBundle bundle;
    bundle.parameters.head<4>() << f, f, 0.5 * (width - 1), 0.5 * (height - 1);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const std::vector<Pose> poses = planar_poses(plane_views[v], bundle.parameters);
      if (poses.empty())
        throw Error(fmt::format("calibrate camera: {}: no pose of the board fits", printable(views[v]->name)));
      bundle.T_camera_board.push_back(poses.front());
    }
    return bundle;
  } catch (const VisionError& error) {
    throw Error(fmt::format("calibrate camera: OpenCV: {}", error.what()));
  }
}

bool unmirror_poses(std::span<const BoardView* const> views, CameraBundle& bundle) {
  bool changed = false;
  for (std::size_t v = 0; v < views.size(); ++v) {
    try {
      for (const Pose& pose : planar_poses(to_plane_view(*views[v]), bundle.parameters)) {
        if (view_sum_of_squares_px2(*views[v], bundle.parameters, pose) <
            view_sum_of_squares_px2(*views[v], bundle.parameters, bundle.T_camera_board[v])) {
          bundle.T_camera_board[v] = pose;
          changed = true;
        }
      }
    } catch (const VisionError&) {
      continue;  // the pose that there is stays
    }
  }
  return changed;
}

}  // namespace asperity
