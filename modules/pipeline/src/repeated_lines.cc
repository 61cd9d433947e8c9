#include "repeated_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "asperity/profile/lay_merge.h"
#include "asperity/profile/merge_passes.h"

namespace asperity {

namespace {

constexpr std::ptrdiff_t kLeastHeights = 600;  // 15 mm at 25 µm
// merge_passes.h has the derivation.
constexpr double kMostLines_over_noise = 0.5;
constexpr double kMostNoise_scale = 1.25;  // more is not the stated noise

std::string pass_name(const std::string& scan, const Profile& profile, const LinePass& part) {
  return fmt::format("{}{}{:.1f} to {:.1f} mm", scan, scan.empty() ? "" : ", ", 1e3 * profile.s_m[part.first],
                     1e3 * profile.s_m[part.last - 1]);
}

// The passes are over one line, as far as their differences show: no more than noise, whatever its level.
bool is_one_line(const MergedProfile& merged) {
  return merged.agrees && 2 * merged.used > merged.passes.size() && merged.lines_over_noise < kMostLines_over_noise;
}

// Why the merge is not the better one; empty: it is.
std::string why_not_laid(const MergedProfile& merged) {
  if (!merged.agrees) return "they do not agree by more than chance gives";
  if (2 * merged.used <= merged.passes.size()) return "fewer than half of them agree by more than chance gives";
  if (!std::isfinite(merged.lines_over_noise)) return "their difference is not known";
  if (merged.noise_scale > kMostNoise_scale)
    return fmt::format("they differ by more than the noise that they state explains, {:.2g} times its power",
                       merged.noise_scale);
  if (merged.lines_over_noise < kMostLines_over_noise) return "";
  return fmt::format(
      "their lines differ by {:.2g} times the power of their noise, as lines {:.2g} mm apart do: each is nearer to its "
      "own line than their mean is",
      merged.lines_over_noise, 1e3 * merged.apart_m);
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

std::vector<Eigen::Vector3d> points_under_profile(const BasePath& path, const Profile& profile) {
  std::vector<Eigen::Vector3d> out(profile.size(), Eigen::Vector3d::Constant(kNan));
  std::size_t i = 0;
  for (std::size_t j = 0; j < out.size() && path.size() > 0; ++j) {
    while (i + 1 < path.size() && path.s_m[i + 1] <= profile.s_m[j]) ++i;
    out[j] = path.p_world_m[i];
  }
  return out;
}

RepeatedLine merge_line(const SharedLine& line, std::span<MeasuredProfile* const> measured,
                        std::span<const std::string> names) {
  RepeatedLine out;
  std::vector<ProfilePass> passes;
  std::vector<LinePass> parts;
  for (const LinePass& part : line) {
    const MeasuredProfile& of = *measured[part.scan];
    const auto begin = of.measured_texture_m.begin();
    const auto heights =
        std::count_if(begin + static_cast<std::ptrdiff_t>(part.first), begin + static_cast<std::ptrdiff_t>(part.last),
                      [](double texture_m) { return std::isfinite(texture_m); });
    // Without a noise of its own nothing says what a pass weighs.
    if (heights < kLeastHeights || of.noise.added_psd_m2_mm.empty()) continue;
    passes.push_back(profile_pass(pass_name(names[part.scan], of.profile, part), of.profile, of.measured_texture_m,
                                  of.noise, part.first, part.last));
    passes.back().place = part.place;
    parts.push_back(part);
    out.spans.push_back({part.scan, of.profile.s_m[part.first], of.profile.s_m[part.last - 1]});
  }
  if (passes.size() < 2) return out;
  out.merged = merge_passes(passes, {});
  out.reason = why_not_laid(out.merged);
  out.laid = out.reason.empty();
  out.one_line = is_one_line(out.merged);
  if (out.laid) {
    std::map<std::size_t, std::vector<PassInProfile>> by_scan;
    for (std::size_t k = 0; k < parts.size(); ++k) by_scan[parts[k].scan].push_back({k, parts[k].first});
    for (const auto& [scan, passes_in_it] : by_scan) {
      MeasuredProfile& of = *measured[scan];
      lay_merge(out.merged, passes_in_it, of.profile, of.noise);
      of.measured_texture_m = of.profile.texture_m;
    }
  }
  out.merged.profile = {};
  for (MergedPass& pass : out.merged.passes) pass.on_merge.clear();
  return out;
}

void merge_recorded_lines(const BasePathResult& base, MeasuredProfile& measured) {
  if (measured.noise.added_psd_m2_mm.empty()) return;
  const std::vector<std::vector<Eigen::Vector3d>> paths{points_under_profile(base.path, measured.profile)};
  const std::vector<std::string> names{""};
  MeasuredProfile* const only = &measured;
  for (const SharedLine& line : find_shared_lines(paths, measured.profile.spacing_m)) {
    RepeatedLine merged = merge_line(line, std::span(&only, 1), names);
    if (!merged.merged.passes.empty()) measured.lines.push_back(std::move(merged));
  }
}

}  // namespace asperity
