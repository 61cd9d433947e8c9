#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/tracking/track_body.h"
#include "grey_band.h"

namespace asperity {

// A tag of the body as the detector and the image's fit have seen it.
struct FoundTag {
  TagDetection detection;
  SeenTag seen;
};

// Finds the tags of a body in one image after another: by their borders, in bands of grey where they are faint, and by
// their picture alone where their border is covered. Keeps from image to image how sharp each tag was, and the band in
// which the body was seen. `body` may change its places, not its tags.
class TagSearch {
 public:
  // Throws Error for a family or an id that is not known.
  TagSearch(CameraCalibration camera, const std::vector<MarkerPlacement>& body, const TrackConfig& config);

  // In a part of the image, in the band of grey that served before if there is one.
  void find(const GrayImage& image, const ImageRegion& region, const std::vector<MarkerPlacement>& body,
            std::vector<FoundTag>& out) {
    find_in(image, region, body, band_, out);
  }
  // In the whole image, in all levels.
  void find_in_whole(const GrayImage& image, const std::vector<MarkerPlacement>& body, std::vector<FoundTag>& out) {
    find_in(image, whole(image), body, std::nullopt, out);
  }
  void forget_band() { band_.reset(); }

  // The whole image in each of the overlapping bands of grey; the band that shows most tags is kept for the next image.
  void find_faint(const GrayImage& image, const std::vector<MarkerPlacement>& body, std::vector<FoundTag>& out);

  // Adds tags that the detector has missed, most often because their border is covered in part, by their picture alone,
  // where the pose of those in `found`, at least one, says that they are. True if one was found.
  bool find_covered(const GrayImage& image, const std::vector<MarkerPlacement>& body, const Pose& T_camera_marker,
                    std::vector<FoundTag>& found);

 private:
  struct Family {
    std::string name;
    std::unique_ptr<TagDetector> detector;
  };

  // `in`: the grey levels that are looked at; nullopt for all of them.
  void find_in(const GrayImage& image, const ImageRegion& region, const std::vector<MarkerPlacement>& body,
               const std::optional<GreyBand>& in, std::vector<FoundTag>& out);
  void detect(const GrayImage& view, const ImageRegion& region, const std::vector<MarkerPlacement>& body,
              std::vector<FoundTag>& out) const;
  void refine(const GrayImage& image, std::vector<FoundTag>& found);

  CameraCalibration camera_;
  TrackConfig config_;
  std::vector<Family> families_;
  std::vector<TagPattern> patterns_;  // of the body's tags
  std::vector<PointSpread> spreads_;  // as last seen of each
  std::optional<GreyBand> band_;      // in which the body was last seen, where it is not seen without
  int faint_misses_ = 0;              // images in a row without a tag in any band
  std::size_t next_band_ = 0;         // to be tried where one an image has to do
};

}  // namespace asperity
