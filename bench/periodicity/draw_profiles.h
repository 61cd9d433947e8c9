#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/random.h"

namespace bench {

inline constexpr double kProfileSpacing_mm = 0.025;
inline constexpr double kProfileRq_m = 10e-6;

double log_uniform(asperity::Random& random, double low, double high);

// Its mean taken off, scaled to this RMS.
std::vector<double> scaled(std::vector<double> x, double rms);

// A kind of random surface: heights at kProfileSpacing_mm, RMS kProfileRq_m; nan in gaps.
struct ProfileFamily {
  const char* name;
  std::function<std::vector<double>(std::size_t points, asperity::Random&)> draw;
};

const std::vector<ProfileFamily>& random_families();

// One period of a sine, triangle, saw or of ribs, from −1 to 1, u from 0 to 1.
double shape_at(const std::string& shape, double u);

// Each period is longer or shorter by `jitter`, relative, and so moves all that follow.
std::vector<double> draw_pattern(const std::string& shape, double pitch_mm, double jitter, std::size_t points,
                                 asperity::Random& random);

// An arc of a circle of this height over its chord, points at kProfileSpacing_mm along it, m.
std::vector<Eigen::Vector2d> draw_arc(double sagitta_mm, std::size_t points);

// Heights over a path (m) of an isotropic relief: 300 plane waves in random directions, their frequencies within a
// relative width of one.
std::vector<double> draw_relief(double width, const std::vector<Eigen::Vector2d>& path_m, asperity::Random& random);

// Heights over a path (m) of round holes of 0.6 of a pitch on a square lattice that is turned from the path's chord.
std::vector<double> draw_holes(double pitch_m, double turned_rad, const std::vector<Eigen::Vector2d>& path_m,
                               asperity::Random& random);

}  // namespace bench
