#pragma once

#include <span>

#include <Eigen/Core>

#include "asperity/base/nan.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

struct ElementWidth {
  double mean_m = kNan;
  double stderr_m = kNan;
};

// RSm of a pattern whose single elements are lost in noise: its pitch over the number of elements of its mean period
// (ISO 21920-2: an element is a hill and the pit next to it, each at least `config.element_height` of Rz). Averaging
// over the periods leaves of noise that does not repeat 1/√periods.
//
// `height_m` is the texture with its noise removed (m, nan in gaps), `noise` that of it. Not determined (nan) where no
// pattern is periodic, where its period changes along the path for another reason than the path's bend over straight
// ribs, where the profile is filtered, where the noise that the
// mean period keeps reaches the least height of an element, where what does not repeat may be as high and is not noise
// (it splits elements), and where the number of elements is not the same with half and with twice that height. The
// standard error is the pitch's, and one element more or less over the whole profile: single periods may have one that
// their mean has not.
ElementWidth pattern_element_width(std::span<const double> height_m, double spacing_m, const Periodicity& pattern,
                                   const TextureNoise& noise, const RoughnessConfig& config = {});

// The same of a path that bends, `unrolled_m` its points (unroll_path.h), one for each height, or empty. Over straight
// ribs the heights repeat in the ribs' coordinate, in which the mean period is taken. The mean width along the path is
// the path's length over the number of elements: the spread of the single ones along the path is not in its error,
// except where a part of the path, with the wider or the narrower ones, has no heights.
ElementWidth pattern_element_width(std::span<const double> height_m, double spacing_m, const Periodicity& pattern,
                                   const TextureNoise& noise, const RoughnessConfig& config,
                                   std::span<const Eigen::Vector2d> unrolled_m);

}  // namespace asperity
