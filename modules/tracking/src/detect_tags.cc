#include "asperity/tracking/detect_tags.h"

#include "apriltag_detector.h"
#include "aruco_tag_detector.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

std::unique_ptr<TagDetector> make_tag_detector(const std::string& family, const TagDetectorConfig& config) {
  if (is_apriltag_family(family)) return make_apriltag_detector(family, config);
  if (is_aruco_family(family)) return make_aruco_tag_detector(family);
  throw Error("markers: family '" + printable(family) +
              "' is none of tag36h11, tag25h9, tag16h5, tagStandard41h12, aruco:NAME and aruco:FILE.yml");
}

}  // namespace asperity
