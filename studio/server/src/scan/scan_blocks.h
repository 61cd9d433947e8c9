#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asperity/live/scan_hints.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/recording/calibration.h"
#include "asperity/studio/block.h"
#include "scan/row_tap.h"

namespace asperity::studio {

// Rows of the probe with their units: t_s since `origin_ns`, force_N (nan without a new reading), accel_mps2
// (three a row, specific force in the marker's frame). Without a calibration counts, and "calibrated" is false. The
// head's "sequence" is the first row's number, "newest_ns" the newest row's time.
BlockWriter probe_block(std::span<const ProbeSample> rows, std::uint64_t first_row, std::uint64_t dropped,
                        std::int64_t origin_ns, const std::optional<Calibration>& calibration);

// A camera's image with the tags found in it: "tags" [{"id","corners_px":[x0,y0,…]}] in pixels of this image, and
// "reprojection_px" of the full one.
BlockWriter image_block(const SeenImage& seen);

// The state of a running recording (docs/studio-scan.md).
Json recorder_json(const RecorderSnapshot& now);
// The camera's size and focal lengths, for its frustum.
Json camera_json(const CameraCalibration& camera);
// [{"kind","severity","text"}]
Json hints_json(const std::vector<Hint>& hints);

}  // namespace asperity::studio
