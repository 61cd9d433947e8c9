#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/image/gray_image.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// Images of a body of tags, drawn without any of the code under test but the camera model: each pixel is the mean of
// rays to the tags' planes, so that its errors are known by their number.
struct TagScene {
  CameraCalibration camera;
  std::vector<MarkerPlacement> body;  // of AprilTag's families
  double defocus_px = 0.6;            // standard deviation of a Gaussian, beside the pixel itself
  double noise = 2.5;                 // grey levels
  double black = 30.0, white = 205.0;
  double shade = 0.1;  // of the light, from the left of the image to the right
  bool clutter = true;
  int rays = 5;  // across a pixel
  // The body's motion while the shutter is open, from −1/2 to 1/2 of it: camera's axes.
  Eigen::Vector3d motion_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
};

struct Blob {  // covers what it lies on: a finger, a highlight
  Eigen::Vector2d centre_px;
  double radius_px = 0.0;
  double grey = 90.0;
};

GrayImage draw(const TagScene& scene, const Pose& T_camera_marker, std::uint64_t seed,
               const std::vector<Blob>& blobs = {});

// 640×480 with a lens that bends: about 56° wide.
CameraCalibration test_camera();
// Two tags of 46 mm one above the other in a plane, as on the seed's probe.
std::vector<MarkerPlacement> flat_pair();
// Three tags of 46 mm on neighbouring sides of a hexagonal sleeve.
std::vector<MarkerPlacement> sleeve();

// The body's middle at `distance_m`, turned away from the camera by up to `tilt_rad` and anyhow about the axis.
Pose random_view(double distance_m, double tilt_rad, std::uint64_t seed);

}  // namespace asperity
