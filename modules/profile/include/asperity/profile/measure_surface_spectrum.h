#pragma once

#include <span>

#include "asperity/profile/measure_spectrum.h"
#include "asperity/profile/surface_spectrum.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// The spectrum of what a noisy profile is of (docs/texture-noise.md): Welch's estimate M of the measured heights (m,
// nan in gaps; no noise removed) less the density N of the added noise. The noise is taken through the same gaps as
// little as the heights are: both are densities over what was measured.
//
// The interval is that of the random process of which the profile is a stretch. ν M / E[M] has a χ² distribution with
// ν = 2K/(1 + 2 (1 − 1/K)/36) degrees of freedom for K segments with Hann windows that overlap by half (Welch 1967: the
// squared correlation of neighbours is 1/36; half of ν at 0 and at half the sampling rate). The level of N is
// log-normal, with the relative standard error of its power. Both are combined for the difference by the method of
// variance estimates recovery (Zou and Donner, Stat. Med. 27, 2008); in it are also the heights' scale, twice
// `scale_sigma`, and what noise that comes with the contact does with or against the surface, 2 √(S N_c)/√3.
//
// Without a noise the measured density, without intervals. Empty, and Throws Error, as measure_spectrum() does.
SurfaceSpectrum measure_surface_spectrum(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const SpectrumConfig& config = {});

}  // namespace asperity
