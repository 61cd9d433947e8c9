#pragma once

#include "asperity/base/progress.h"
#include "asperity/texture/height_map_model.h"
#include "asperity/texture/texture.h"

namespace asperity {

struct HeightMapFit {
  HeightMap texture;
  double rms_height_m = 0.0;
  double quantisation_m = 0.0;  // height of one level: range / (2^bits − 1); a pixel errs by half of it at most
  double rms_error_m = 0.0;     // against the model between the pixels, the seams' blends left out
  std::size_t clipped = 0;      // pixels beyond range_mm
  double height_offset_m = 0.0;
};

// A height field sampled into an image (thesis §6.5, Fig. 38: 256 points over [0, 10 mm], 2.5 mm in 256 levels).
// A tile whose length is no multiple of the model's period is closed along x and along y: over the first
// `seam_mm` its heights h(x) pass, by a smooth step w, over from the continuation of its end,
// (1 − w) h(x + L) + w h(x), so that it repeats without a step in height or slope. With range_mm given, the
// range is laid about the middle of the heights and heights outside are clipped. Throws Error for a model
// that is not a height field, 9 to 15 bits, or a seam longer than half the tile.
HeightMapFit make_height_map(const TextureModel& model, const MakeHeightMapConfig& config = {},
                             const Observer& observer = {});

}  // namespace asperity
