#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/image/gray_image.h"

namespace asperity {

// OpenCV could not do what it was asked to; in its own words.
class VisionError : public Error {
 public:
  using Error::Error;
};

// The square markers of ArUco (Garrido-Jurado et al., 2014): `bits` by `bits` cells within a black border of one cell.
struct ArucoDictionary {
  int bits = 0;                                    // cells a side, without the border
  std::vector<std::vector<std::uint8_t>> markers;  // by id: bits·bits cells, row by row, 1 for white
  int correctable_bits = 0;                        // wrong cells with which a marker is still told from all others
};

// A marker as OpenCV's detector found it; corners top left, top right, bottom right, bottom left of the marker upright.
struct FoundMarker {
  int id = 0;
  std::array<Eigen::Vector2f, 4> corner_px;
};

// Finds the markers of one dictionary. One thread at a time.
class MarkerFinder {
 public:
  virtual ~MarkerFinder() = default;
  virtual std::vector<FoundMarker> find(const GrayImage& image) const = 0;
};

struct MarkerFinderConfig {
  int allowed_wrong_bits = 0;
  double smallest_perimeter = 0.03;  // of a marker, over the image's larger side
};

// Points of a plane, m, its z = 0, and where they are seen, px.
struct PlaneView {
  std::vector<Eigen::Vector3f> p_plane_m;
  std::vector<Eigen::Vector2f> seen_px;
};

// From the plane's coordinates to the camera's.
struct PlanePose {
  Eigen::Vector3d rotation_rad;  // about its axis, by its length
  Eigen::Vector3d translation_m;
};

// A ChArUco board: squares, of a dictionary of OpenCV's.
struct CharucoLayout {
  int columns = 0, rows = 0;
  float square_m = 0.0f, marker_m = 0.0f;
  int dictionary = 0;  // PredefinedDictionary::opencv_id
};

struct CharucoCorners {
  std::vector<int> id;  // inner corners, row by row
  std::vector<Eigen::Vector2f> corner_px;
};

// Part of an image, px.
struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
};

// What OpenCV does for us. It is a library of its own (libasperity_vision.so), loaded at first use: OpenCV brings along
// some thirty libraries, which most runs of the program never need. Each function throws VisionError where OpenCV does.
struct Vision {
  // Both sides must be of one build, for C++ types cross between them: kVersion, and the compiler's __VERSION__.
  const char* program;
  const char* compiler;

  ArucoDictionary (*predefined_dictionary)(int opencv_id);
  std::unique_ptr<MarkerFinder> (*make_marker_finder)(const ArucoDictionary& dictionary,
                                                      const MarkerFinderConfig& config);
  CharucoCorners (*find_charuco)(const GrayImage& image, const CharucoLayout& board);

  // The inner corners of a checkerboard row by row, empty if it is not seen whole: by its quads or, surer in blur, by
  // its sectors (Duda and Frese, 2018).
  std::vector<Eigen::Vector2f> (*find_checkerboard)(const GrayImage& image, int columns, int rows, bool by_sectors);
  // Moves corners to where the gradients around them point (Förstner and Gülch, 1987), in windows of half that width.
  void (*refine_corners)(const GrayImage& image, int half_window_px, std::vector<Eigen::Vector2f>& corners_px);

  // The poses, at most two, of a square of corners (−, +), (+, +), (+, −), (−, −), z = 0, seen along the rays (x, y, 1)
  // (IPPE; Collins and Bartoli, 2014).
  std::vector<PlanePose> (*square_poses)(double half_m, const std::array<Eigen::Vector2d, 4>& rays);
  // The same of any points of a plane; the better first. Camera: fx, fy, cx, cy, k1, k2, p1, p2, k3.
  std::vector<PlanePose> (*plane_poses)(const PlaneView& view, const std::array<double, 9>& camera);
  // The closed form of Zhang (2000), the principal point in the middle; fx, px.
  double (*start_focal_px)(const std::vector<PlaneView>& views, int width, int height);

  // The box's pixels through a Gaussian of `sigma_px`; those around it count too.
  GrayImage (*blur)(const GrayImage& image, const PixelBox& box, double sigma_px);
};

// Loads the library if that is not yet done. Throws Error naming the paths searched if it is missing or of another
// build; any thread.
const Vision& vision();

}  // namespace asperity
