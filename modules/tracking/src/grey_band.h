#pragma once

#include <vector>

#include "asperity/image/gray_image.h"
#include "asperity/tracking/detect_tags.h"

namespace asperity {

// A part of the grey levels: what is darker is black, what is brighter white.
struct GreyBand {
  int low = 0, width = 256;
};

// Bands that overlap by half and together hold all levels. A detector's threshold is midway between the darkest and the
// brightest of its surroundings: beside a tag of little contrast a bright or dark background takes it out of the tag's
// own levels. In a band that holds the tag the background is no farther away than the band is wide.
std::vector<GreyBand> grey_bands();

// The region's pixels, smoothed by a Gaussian of 0.8 px and stretched so that the band fills all levels.
GrayImage stretch_band(const GrayImage& image, const ImageRegion& region, const GreyBand& band);

}  // namespace asperity
