#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"
#include "asperity/profile/time_line.h"

namespace asperity {

// The narrow lines that heights have over the time at which the tip passed them (docs/texture-noise.md).
//
// A surface's pattern is a line over the path. A hand changes its speed, so over time a pattern is smeared, and hum is
// smeared over the path. The heights `height_m` (one for each point of `profile`, m, nan in gaps) are taken in windows
// (Hann) of at most 8 s, at least half full, by the path and by the time (Profile::t_s; where it is empty, by the
// speeds); both periodograms are means over the windows. A line over time is an ordinate that
//   - noise of the spectrum about it exceeds once in 1,000 profiles (of exponential ordinates, the mean that of the
//     neighbours' median), and three times that mean,
//   - falls to half within three independent ordinates to both sides,
//   - is at least half of the highest ordinate over the path at the frequencies that this wave has there, those between
//     f over the 95th percentile of the speed and f over the 5th.
// It is not of the surface if it is at least twice that ordinate, and what the errors of places (place_sigma_m,
// standard deviation) leave of a line of the path, exp(−(2πk σ)²), is above 0.3 and does not explain the difference. On
// a path that bends (unrolled_m, as for find_periodicity_under_noise.h) ribs are waves of unequal length: it must as
// well be twice the highest ordinate of straight ribs in any direction. Otherwise, without a place_sigma_m (nan), and
// where so many directions and waves would have to be tried that they are not, it could be of the surface. Searched is
// from 27 over the window's length to the frequency at which four points make a wave. Lines weaker than 0.5 % of the
// heights' power are left out. The strongest first; none without speeds.
std::vector<TimeLine> find_time_lines(const Profile& profile, std::span<const double> height_m, double place_sigma_m,
                                      std::span<const Eigen::Vector2d> unrolled_m = {});

// Adds the lines that are not of the surface, `noise.time_lines` without those that could be, to the noise of a
// profile: their power, at each point's own frequency f/v along the path, to the density of the added noise, and to all
// that is computed of it: standard deviations of heights and texture, RMS, SNR, the upper bound. Nothing is done where
// the noise is not known.
void add_time_lines(Profile& profile, TextureNoise& noise);

}  // namespace asperity
