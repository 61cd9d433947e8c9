#pragma once

#include <array>
#include <string_view>

#include "asperity/base/config.h"

namespace asperity {

enum class RegistrationNormals { kInterpolated, kFacet };
inline constexpr std::array<std::string_view, 2> kRegistrationNormalsNames{"interpolated", "facet"};

// How the points of the first iterations are chosen (docs/registration.md).
enum class PathSampling { kUniform, kCurvature, kNormalSpace, kStability };
inline constexpr std::array<std::string_view, 4> kPathSamplingNames{"uniform", "curvature", "normal_space",
                                                                    "stability"};

// When starts other than the guess are tried.
enum class OtherStarts { kNever, kDoubtful, kAlways };
inline constexpr std::array<std::string_view, 3> kOtherStartsNames{"never", "doubtful", "always"};

struct StartsConfig {
  OtherStarts when = OtherStarts::kDoubtful;
  int count = 40;
  int points = 80;
  int refined = 4;
  double radius_m = 15e-3;
  double turn_deg = 25.0;
  double doubtful_ratio = 1.5;
  double doubtful_outliers = 0.25;

  template <class V>
  void visit(V& v) {
    v.choice("when", when, kOtherStartsNames,
             "starts other than the guess: never, doubtful (when the fit has a quality warning) or always");
    v.field("count", count, "of other starts", {0, 100000});
    v.field("points", points, "of the path that each runs with", {20, 100000});
    v.field("refined", refined, "best starts that are run to the end", {1, 1000});
    v.field("radius_m", radius_m, "largest shift of a start from the guess, m", {0.0, 1e3});
    v.field("turn_deg", turn_deg, "largest rotation of a start from the guess, degrees", {0.0, 180.0});
    v.field("doubtful_ratio", doubtful_ratio,
            "of the residual to the path's noise, from which a fit has a quality warning", {1.0, 1e3});
    v.field("doubtful_outliers", doubtful_outliers, "fraction of outliers from which a fit has a quality warning",
            {0.0, 1.0});
  }
};

struct RegistrationConfig {
  RegistrationNormals normals = RegistrationNormals::kInterpolated;
  PathSampling sampling = PathSampling::kUniform;
  int coarse_points = 200;
  int max_points = 5000;
  int max_iterations = 60;
  double robust_sigmas = 3.5;
  double outlier_sigmas = 4.0;
  double max_distance_m = 0.0;
  double facing_deg = 100.0;
  double isotropic = 1.0;
  double isotropic_decay = 0.6;
  double guess_sigma_m = 20e-3;
  double guess_sigma_deg = 20.0;
  double error_length_m = 0.0;
  double undetermined_m = 0.5e-3;
  double slide_m = 2e-3;
  double surface_error_m = 2e-6;
  StartsConfig starts;

  template <class V>
  void visit(V& v) {
    v.choice("normals", normals, kRegistrationNormalsNames, "direction in which a distance is taken to change");
    v.choice("sampling", sampling, kPathSamplingNames, "how the points of the first iterations are chosen");
    v.field("coarse_points", coarse_points, "points of the first iterations", {20, 1000000});
    v.field("max_points", max_points, "points of the last ones, uniform in length; 0 for all", {0, 100000000});
    v.field("max_iterations", max_iterations, "limit of each stage", {1, 100000});
    v.field("robust_sigmas", robust_sigmas, "width of the robust weight over the scale of the distances", {1.0, 1e6});
    v.field("outlier_sigmas", outlier_sigmas, "distance over the scale from which a point is an outlier", {2.0, 1e6});
    v.field("max_distance_m", max_distance_m, "pairs farther apart do not count, m; 0: no limit", {0.0, 1e3});
    v.field("facing_deg", facing_deg,
            "largest angle of the probe's direction, where given, to the normal, degrees; 180: no limit", {0.0, 180.0});
    v.field("isotropic", isotropic, "weight of the offset along the surface in the first step, 0 to 1", {0.0, 1.0});
    v.field("isotropic_decay", isotropic_decay, "its factor from step to step", {0.0, 0.99});
    v.field("guess_sigma_m", guess_sigma_m, "how well the guess is known, RMS over the points, m", {1e-9, 1e6});
    v.field("guess_sigma_deg", guess_sigma_deg, "how well its rotation is known, degrees", {1e-6, 1e6});
    v.field("error_length_m", error_length_m, "length of path over which errors last, m; 0: each point has its own",
            {0.0, 1e3});
    v.field("undetermined_m", undetermined_m, "standard deviation from which a motion is undetermined, m", {1e-9, 1e3});
    v.field("slide_m", slide_m, "motion that is tried to find that out, RMS over the points, m", {1e-9, 1e3});
    v.field("surface_error_m", surface_error_m, "of the mesh against the object, in addition to its facets' sag, m",
            {0.0, 1e3});
    v.group("starts", starts);
  }
};

}  // namespace asperity
