#pragma once

#include <vector>

#include "asperity/recording/calibration.h"

namespace asperity {

// Bodies of tag36h11 tags on the probe, as they were made: T_marker_tag exact. A tag's frame has its origin in the
// tag's centre, x right, y down and z into the tag, away from who reads it.

// Two tags one above the other on the front, in the plane z = 0 of the marker frame, the marker's origin midway: with
// 46 mm and a gap of 6 mm the marker of the seed, 46 mm × 98 mm (Fig. 6). Ids `first_id` (upper) and the next.
std::vector<MarkerPlacement> front_tag_body(double size_m = 0.046, double gap_m = 0.006, int first_id = 0);

// Six tags on a hexagonal prism about the marker's y axis, readable from all sides (thesis §7.2). The first faces the
// camera when the marker frame equals the camera's; the marker's origin is on the axis. The faces are 1.25 times as
// wide as the tags: the white margin of one cell.
std::vector<MarkerPlacement> ring_tag_body(double size_m = 0.030, int first_id = 0);

}  // namespace asperity
