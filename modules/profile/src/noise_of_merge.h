#pragma once

#include <span>

#include "asperity/profile/texture_noise.h"
#include "average_passes.h"

namespace asperity {

// The noise of a mean of passes, as estimate_texture_noise() gives that of one: added noise is averaged, places are the
// mean of the passes' places; scales and noise that comes with the contact are taken to be the same in all.
TextureNoise noise_of_merge(const AveragedPasses& mean, std::span<const PassOnGrid> passes, double spacing_mm,
                            double default_place_sigma_m);

}  // namespace asperity
