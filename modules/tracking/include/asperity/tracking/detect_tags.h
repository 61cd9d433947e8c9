#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/image/gray_image.h"
#include "asperity/tracking/tag_pattern.h"
#include "asperity/tracking/tracked_pose.h"

namespace asperity {

// A part of an image: columns left to right and rows top to bottom, the second ones exclusive.
struct ImageRegion {
  int left = 0, top = 0, right = 0, bottom = 0;

  int width() const { return std::max(0, right - left); }
  int height() const { return std::max(0, bottom - top); }
  bool empty() const { return width() == 0 || height() == 0; }
};

inline ImageRegion whole(const GrayImage& image) { return {0, 0, image.width, image.height}; }

struct TagDetectorConfig {
  double quad_decimate = 1.5;  // borders are sought in the image reduced by this
  int bits_corrected = 1;      // wrong bits of a code that are put right

  template <class V>
  void visit(V& v) {
    v.field("quad_decimate", quad_decimate, "borders are sought in the image reduced by this", {1.0, 8.0});
    v.field("bits_corrected", bits_corrected, "wrong bits of a code that are put right", {0, 2});
  }
};

// Finds the tags of one family. One thread at a time.
class TagDetector {
 public:
  virtual ~TagDetector() = default;

  // Appends the tags in `region` of the image. Their corners are in px of the whole image, the centre of its first
  // pixel at (0, 0), in the order (−,−), (+,−), (+,+), (−,+) of the tag's frame (x right, y down as the tag is drawn by
  // AprilTag): top left, top right, bottom right, bottom left of a tag seen upright.
  virtual void detect(const GrayImage& image, const ImageRegion& region, std::vector<TagDetection>& out) = 0;

  // The tag's picture; nullopt for an id that the family does not have.
  virtual std::optional<TagPattern> pattern(int id) const = 0;
};

// AprilTag's families: tag36h11, tag25h9, tag16h5, tagStandard41h12.
std::vector<std::string_view> apriltag_families();

// True for one of these.
bool is_apriltag_family(std::string_view family);

// True for "aruco:DICT_4X4_50" and the like, and "aruco:FILE.yml" (aruco_dictionary.h).
bool is_aruco_family(std::string_view family);

// A detector of `family`. Throws Error for one that is not known.
std::unique_ptr<TagDetector> make_tag_detector(const std::string& family, const TagDetectorConfig& config = {});

}  // namespace asperity
