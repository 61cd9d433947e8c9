#include "asperity/verdict/judge_registration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kLeastInliers = 0.5;  // with fewer the path is not on this mesh
constexpr double kOffShare = 0.1;      // of the path: more than an end that was lifted off too late
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMisfit = 5.0;  // residual over what is explained; a path has few independent centimetres
// A mesh made by photogrammetry or a handheld scanner can be wrong by some tenths of a percent of its size, which the
// settings do not state unless the user does. Beyond this share of the path's extent it is no error of a mesh.
constexpr double kMeshError = 0.03;
constexpr double kGuessSigmas = 4.0;  // 0.1 % of right guesses are farther off (χ², three coordinates)

// Known less well than this, a pose can be off by more than some millimetres or degrees.
constexpr double kKnown_m = 1e-3;
constexpr double kKnown_rad = 1.5 / kDegrees;
constexpr double kSlowRatio =
    3.5;  // a slow error this much larger than stated is an error of the mesh, or another mesh
constexpr double kOutlying = 0.25;  // share of the paths

// One of ten other objects would pass the first alone; it has to pass all that is above, too. Where the paths lie as
// near the mesh as their stated errors say (which hold to a factor of 1.25, docs/accuracy.md), that speaks for the mesh
// itself, and it is enough that the pose stands out at all.
constexpr double kChance = 0.1;
constexpr double kChanceAsStated = 0.5;
constexpr double kGoodTracker_m = 0.1e-3;  // a drift per axis that a tracker may well have, if none is stated
constexpr double kSlowAsStated = 1.3;
constexpr double kRatioSigmas = 2.0;

// On the mesh of another object a path is as likely as its own mirror image, and so it is on the right one if it is its
// own image to within its errors. The same odds as for another pose (pose_rivals.cc).
constexpr double kMirrorOdds = 0.01;

// The mesh's size. A scanner's mesh and the tracker's markers are each allowed a scale error of some tenths of a
// percent before a pose is refused for it.
constexpr double kScaleError = 0.005;
constexpr double kScaleSigmas = 3.5;    // one right scan in two thousand is farther off
constexpr double kScaleUnknown = 0.05;  // known less well, nothing is said of the size

// How far the size is from the mesh's own, as a logarithm.
double size_off(const PoseEvidence& evidence) { return std::abs(std::log(evidence.mesh_scale)); }

// What the scan allows for that, the two errors included.
double size_limit(const PoseEvidence& evidence) {
  return kScaleSigmas * std::hypot(evidence.mesh_scale_sigma, kScaleError);
}

// Both the curvature at the best size and the likelihood on the way from the stated one have to say it.
bool size_shown(const PoseEvidence& evidence) {
  return size_off(evidence) > kScaleSigmas * evidence.mesh_scale_sigma &&
         evidence.mesh_scale_gain > kScaleSigmas * kScaleSigmas;
}

// With as many decimals as show two digits of the standard error.
std::string fitting_size(const PoseEvidence& evidence) {
  constexpr int kLeastDecimals = 3, kMostDecimals = 9;
  const double sigma = evidence.mesh_scale * evidence.mesh_scale_sigma;
  const int decimals =
      sigma > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), kLeastDecimals, kMostDecimals)
                  : kLeastDecimals;
  return fmt::format("the scan fits the mesh best at {:.{}f} ± {:.{}f} of its size", evidence.mesh_scale, decimals,
                     sigma, decimals);
}

// The path, or a part of it, is not over the mesh at all.
void judge_distance(const PoseEvidence& evidence, Verdicts& out) {
  const auto points = static_cast<double>(evidence.points);
  const double outlying = evidence.points > 0 ? static_cast<double>(evidence.outliers) / points : 1.0;
  if (evidence.off_share > kOffShare) {
    out.push_back(make_verdict(
        "off_mesh", fmt::format("{:.0f} % of the path is more than {:.2g} mm from the mesh, {:.2g} mm in the median",
                                100.0 * evidence.off_share, 1e3 * evidence.off_limit_m, 1e3 * evidence.off_m)));
  } else if (outlying > 1.0 - kLeastInliers) {
    out.push_back(
        make_verdict("off_mesh", fmt::format("only {:.0f} % of the points are on the mesh", 100.0 * (1.0 - outlying))));
  }
}

// Errors that nobody stated were estimated from the distances that remain at this very pose.
void judge_errors(const PoseEvidence& evidence, Verdicts& out) {
  if (evidence.assumed_drift_m > 0.0) {
    out.push_back(make_verdict(
        "errors_assumed",
        fmt::format("no errors are stated for the path's points: by the distances from the mesh, a drift of {:.2g} mm "
                    "RMS on each axis that lasts for {:.2g} mm of path is assumed",
                    1e3 * evidence.assumed_drift_m, 1e3 * evidence.assumed_length_m)));
  } else if (evidence.independent_assumed) {
    out.push_back(make_verdict("errors_assumed",
                               "no errors are stated for the points, and they do not follow one another: their errors "
                               "are assumed to be independent"));
  }
}

void judge_scale(const PoseEvidence& evidence, Verdicts& out) {
  if (!std::isfinite(evidence.mesh_scale) || !std::isfinite(evidence.mesh_scale_sigma)) {
    out.push_back(make_verdict("mesh_scale_unknown", "the scan does not show the size of the object"));
    return;
  }
  const double off = size_off(evidence), sigma = evidence.mesh_scale_sigma;
  const std::string fits = fitting_size(evidence);
  if (size_shown(evidence)) {
    out.push_back(make_verdict(off > size_limit(evidence) ? "mesh_scale_differs" : "mesh_scale_doubtful", fits));
  } else if (sigma > kScaleUnknown) {
    out.push_back(
        make_verdict("mesh_scale_unknown", fmt::format("the scan does not show the size of the object: {}", fits)));
  }
}

}  // namespace

Verdicts judge_registration(const PoseEvidence& evidence) {
  Verdicts out;
  if (!evidence.converged) {
    out.push_back(
        make_verdict("pose_not_converged", fmt::format("the registration did not converge in {} iteration{}",
                                                       evidence.iterations, evidence.iterations == 1 ? "" : "s")));
  }
  judge_distance(evidence, out);
  judge_errors(evidence, out);
  if (evidence.slow_m > kMisfit * evidence.explained_m) {
    const bool beyond = evidence.slow_m > kMeshError * evidence.extent_m;
    out.push_back(make_verdict(
        beyond ? "pose_misfit" : "mesh_misfit",
        fmt::format("the path is {:.2g} mm RMS from the mesh over centimetres, where its errors explain {:.2g} mm",
                    1e3 * evidence.slow_m, 1e3 * evidence.explained_m)));
  }
  if (evidence.guess_shift_m > kGuessSigmas * evidence.guess_sigma_m ||
      evidence.guess_rotation_rad > kGuessSigmas * evidence.guess_sigma_rad) {
    out.push_back(make_verdict(
        evidence.guess_stated ? "guess_contradicted" : "guess_overruled",
        fmt::format("the pose is {:.3g} mm and {:.3g} degrees from the guess, which is {} to be known to {:.3g} mm and "
                    "{:.3g} degrees",
                    1e3 * evidence.guess_shift_m, kDegrees * evidence.guess_rotation_rad,
                    evidence.guess_stated ? "stated" : "taken", 1e3 * evidence.guess_sigma_m,
                    kDegrees * evidence.guess_sigma_rad)));
  }
  if (evidence.ambiguous) {
    out.push_back(make_verdict("pose_ambiguous",
                               fmt::format("another pose, {:.1f} mm and {:.1f} degrees away, fits as well",
                                           1e3 * evidence.rival_distance_m, kDegrees * evidence.rival_rotation_rad)));
  }
  // What is not known is neither small nor right.
  if (!std::isfinite(evidence.sigma_m) || !std::isfinite(evidence.sigma_rad)) {
    out.push_back(make_verdict("pose_uncertain", "the uncertainty of the pose is not known"));
  } else if (evidence.sigma_m > kKnown_m || evidence.sigma_rad > kKnown_rad) {
    out.push_back(make_verdict(
        "pose_uncertain",
        fmt::format("the paths determine the pose to {:.2g} mm and {:.2g} degrees only (standard deviations)",
                    1e3 * evidence.sigma_m, kDegrees * evidence.sigma_rad)));
  }
  if (!std::isfinite(evidence.slow_ratio) || !std::isfinite(evidence.outlying)) {
    out.push_back(
        make_verdict("shape_unproven", "the difference between the paths and the shape of the mesh is not known"));
  } else if (evidence.slow_ratio > kSlowRatio || evidence.outlying > kOutlying) {
    out.push_back(
        make_verdict("other_shape", fmt::format("in this pose the paths need a drift {:.2g} times as large as stated, "
                                                "and {:.0f} % of their points are not explained by drift",
                                                evidence.slow_ratio, 100.0 * evidence.outlying)));
  }
  const bool as_stated = evidence.slow_ratio <= kSlowAsStated && !(evidence.assumed_drift_m > kGoodTracker_m);
  if (evidence.mirror_log_odds > std::log(kMirrorOdds)) {
    out.push_back(make_verdict("mirror_image_fits",
                               fmt::format("the paths fit the mesh's mirror image {} (log odds {:.1f})",
                                           evidence.mirror_log_odds > 0.0 ? "better than the mesh" : "nearly as well",
                                           evidence.mirror_log_odds)));
  }
  // With no other pose to compare with, only the size of the error can speak for the mesh.
  const double least_ratio = evidence.slow_ratio * std::exp(-kRatioSigmas * evidence.slow_ratio_sigma);
  if (std::isnan(evidence.chance) && least_ratio > kSlowAsStated) {
    out.push_back(make_verdict("shape_unproven",
                               fmt::format("the mesh has no other poses to compare this one with, and the paths need a "
                                           "drift {:.2g} times as large as stated, {:.2g} at least",
                                           evidence.slow_ratio, least_ratio)));
  } else if (std::isnan(evidence.chance) && size_off(evidence) > size_limit(evidence) && !size_shown(evidence)) {
    // It fits about as well at a size far from its own: two valleys, and nothing shows that this one is the object's.
    out.push_back(make_verdict("shape_unproven",
                               "the mesh has no other poses to compare this one with, and " + fitting_size(evidence)));
  } else if (evidence.searched && std::isnan(evidence.chance)) {
    out.push_back(make_verdict("shape_untested",
                               "too few other poses on this mesh can be compared: nothing shows that another object "
                               "would not fit as well"));
  }
  if (evidence.chance > (as_stated ? kChanceAsStated : kChance)) {
    out.push_back(
        make_verdict("shape_unproven", fmt::format("the pose differs from all others on this mesh no more than the "
                                                   "best pose of another object would, with a probability of {:.2g}",
                                                   evidence.chance)));
  }
  judge_scale(evidence, out);
  if (!evidence.searched) {
    out.push_back(make_verdict("rivals_unknown", "no pose elsewhere on the mesh was compared with this one"));
  }
  if (evidence.symmetric_copies > 0 || evidence.symmetric_motion) {
    out.push_back(
        make_verdict("mesh_symmetric", "the mesh maps onto itself: the pose is one of several that are the same"));
  }
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
