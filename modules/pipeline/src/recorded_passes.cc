#include "recorded_passes.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "asperity/profile/merge_passes.h"

namespace asperity {

namespace {

constexpr double kDirection_m = 1e-3;  // over which a direction is measured
constexpr double kAlong = 0.8;         // cosine to the strokes' axis that counts as a stroke
constexpr double kShortestStroke_m = 10e-3;
constexpr double kEnd_m = 1e-3;  // left out beside a turn

// Points of the base path at even arc lengths.
std::vector<Eigen::Vector3d> even_points(const BasePath& path, const Profile& profile) {
  std::vector<Eigen::Vector3d> out(profile.size(), Eigen::Vector3d::Zero());
  std::size_t i = 0;
  for (std::size_t j = 0; j < out.size(); ++j) {
    while (i + 1 < path.size() && path.s_m[i + 1] <= profile.s_m[j]) ++i;
    out[j] = path.p_world_m[i];
  }
  return out;
}

// 1 and −1 along the axis, 0 elsewhere.
std::vector<int> directions(const std::vector<Eigen::Vector3d>& points, std::size_t reach) {
  std::vector<Eigen::Vector3d> direction(points.size(), Eigen::Vector3d::Zero());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = reach; i + reach < points.size(); ++i) {
    const Eigen::Vector3d step = points[i + reach] - points[i - reach];
    if (!(step.norm() > 0.0)) continue;
    direction[i] = step.normalized();
    sum += direction[i] * direction[i].transpose();
  }
  const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(2);
  std::vector<int> out(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = direction[i].dot(axis);
    out[i] = along > kAlong ? 1 : along < -kAlong ? -1 : 0;
  }
  return out;
}

}  // namespace

ProfilePass profile_pass(std::string name, const Profile& profile, std::span<const double> texture_m,
                         const TextureNoise& noise, std::size_t first, std::size_t last) {
  ProfilePass out;
  out.name = std::move(name);
  out.spacing_m = profile.spacing_m;
  for (std::size_t i = first; i < last; ++i) {
    out.texture_m.push_back(texture_m[i]);
    out.slow_m.push_back(profile.height_m[i] - profile.texture_m[i]);
    if (!noise.added_sigma_m.empty()) out.added_sigma_m.push_back(noise.added_sigma_m[i]);
  }
  out.frequency_cycles_per_mm = noise.frequency_cycles_per_mm;
  out.noise_psd_m2_mm = noise.added_psd_m2_mm;
  if (noise.added_rms_m > 0.0) out.noise_relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  out.place_sigma_m = noise.place_sigma_m;
  out.scale_sigma = noise.scale_sigma;
  out.along_sigma = noise.along_sigma;
  out.contact_rms_m = noise.contact_rms_m;
  return out;
}

void merge_recorded_passes(const BasePathResult& base, MeasuredProfile& measured) {
  const Profile& profile = measured.profile;
  const auto points_in = [&](double length_m) {
    return static_cast<std::size_t>(std::lround(length_m / profile.spacing_m));
  };
  const std::vector<int> direction = directions(even_points(base.path, profile), points_in(0.5 * kDirection_m));
  std::vector<ProfilePass> passes;
  std::vector<std::size_t> starts;
  for (std::size_t begin = 0; begin < direction.size();) {
    std::size_t end = begin;
    while (end < direction.size() && direction[end] == direction[begin]) ++end;
    if (direction[begin] != 0 && end - begin >= points_in(kShortestStroke_m)) {
      const std::size_t first = begin + points_in(kEnd_m), last = end - points_in(kEnd_m);
      passes.push_back(profile_pass("stroke " + std::to_string(passes.size() + 1), profile, measured.measured_texture_m,
                                    measured.noise, first, last));
      starts.push_back(first);
    }
    begin = end;
  }
  if (passes.size() < 2) return;
  MergedProfile merged = merge_passes(passes, {});
  if (merged.agrees) {
    const MergedPass& first = merged.passes.front();
    const double start_m = first.used && !first.alignment.reversed ? profile.s_m[starts.front()] + first.shift_m : 0.0;
    measured.profile = std::move(merged.profile);
    for (double& s_m : measured.profile.s_m) s_m += start_m;
    measured.noise = merged.noise;
    measured.measured_texture_m = measured.profile.texture_m;
  }
  merged.profile = {};
  measured.passes = std::move(merged);
}

}  // namespace asperity
