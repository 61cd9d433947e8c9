#include "asperity/profile/filter_profile.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/text.h"
#include "gaussian_filter.h"
#include "robust_gaussian_filter.h"

namespace asperity {
namespace {

std::size_t missing_in(std::span<const double> z) {
  return static_cast<std::size_t>(std::count_if(z.begin(), z.end(), [](double v) { return std::isnan(v); }));
}

void check_profile(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config) {
  require_plausible_spacing(spacing_m, "roughness");
  if (config.sections < 1)
    throw Error("roughness: " + std::to_string(config.sections) + " sections; at least one is needed");
  if (height_m.size() < 2 * static_cast<std::size_t>(config.sections)) {
    throw Error("roughness: " + std::to_string(height_m.size()) + " heights are too few for " +
                std::to_string(config.sections) + " sections");
  }
  require_plausible_heights(height_m, "roughness");
  const std::size_t missing = missing_in(height_m);
  if (missing + 2 > height_m.size() ||
      static_cast<double>(missing) > config.max_missing * static_cast<double>(height_m.size())) {
    throw Error("roughness: " + std::to_string(missing) + " of " + std::to_string(height_m.size()) +
                " heights are missing; allowed is a part of " + number_text(config.max_missing));
  }
}

void subtract_mean(std::vector<double>& z) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double v : z) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  const double mean = sum / static_cast<double>(count);
  for (double& v : z) v -= mean;
}

// The least-squares line over the sample number; the heights' mean is zero already.
void subtract_line(std::vector<double>& z) {
  double sum_x = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) continue;
    sum_x += static_cast<double>(i);
    ++count;
  }
  const double mean_x = sum_x / static_cast<double>(count);
  double sum_xx = 0.0;
  double sum_xz = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) continue;
    const double x = static_cast<double>(i) - mean_x;
    sum_xx += x * x;
    sum_xz += x * z[i];
  }
  const double slope = sum_xz / sum_xx;
  for (std::size_t i = 0; i < z.size(); ++i) z[i] -= slope * (static_cast<double>(i) - mean_x);
}

std::vector<double> mean_line_m(std::span<const double> z, double spacing_m, double cutoff_mm, ProfileFilter filter,
                                const Observer& observer) {
  return filter == ProfileFilter::kRobust ? robust_gaussian_mean_line_m(z, spacing_m, 1e-3 * cutoff_mm, observer)
                                          : gaussian_mean_line_m(z, spacing_m, 1e-3 * cutoff_mm, observer);
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

// Leaves out `length_mm` at either end; false where that leaves fewer than `least` heights.
bool cut_ends(std::vector<double>& z, double spacing_m, double length_mm, std::size_t least) {
  const double samples = std::ceil(1e-3 * length_mm / spacing_m - 1e-6);
  if (!(static_cast<double>(z.size()) - 2.0 * samples >= static_cast<double>(least))) return false;
  const auto count = static_cast<std::ptrdiff_t>(samples);
  z.erase(z.end() - count, z.end());
  z.erase(z.begin(), z.begin() + count);
  return true;
}

}  // namespace

FilteredProfiles filter_profile(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config,
                                const Observer& observer) {
  check_profile(height_m, spacing_m, config);
  FilteredProfiles out;
  std::vector<double>& z = out.primary_m;
  z.assign(height_m.begin(), height_m.end());
  subtract_mean(z);
  if (config.form == ProfileForm::kLine) subtract_line(z);
  if (config.lambda_s_mm > 0.0) z = gaussian_mean_line_m(z, spacing_m, config.lambda_s_mm * 1e-3, observer);
  if (!(config.lambda_c_mm > 0.0)) {
    if (config.lambda_s_mm > 0.0) subtract_mean(z);
    out.roughness_m = z;
    return out;
  }
  out.waviness_m = mean_line_m(z, spacing_m, config.lambda_c_mm, config.filter, observer);
  out.roughness_m = difference(z, out.waviness_m);
  double waviness_end_mm = 0.5 * config.lambda_c_mm;
  if (config.lambda_f_mm > 0.0) {
    out.waviness_m =
        difference(out.waviness_m, mean_line_m(out.waviness_m, spacing_m, config.lambda_f_mm, config.filter, observer));
    waviness_end_mm += 0.5 * config.lambda_f_mm;
  }
  if (config.ends == ProfileEnds::kCut) {
    if (!cut_ends(out.roughness_m, spacing_m, 0.5 * config.lambda_c_mm,
                  2 * static_cast<std::size_t>(config.sections))) {
      throw Error("roughness: too little is left of a profile of " +
                  number_text(1e3 * spacing_m * static_cast<double>(height_m.size())) +
                  " mm when half of the cut-off length " + number_text(config.lambda_c_mm) +
                  " mm is left out at either end");
    }
    if (!cut_ends(out.waviness_m, spacing_m, waviness_end_mm, 2)) out.waviness_m.clear();
  }
  for (auto* profile : {&out.primary_m, &out.roughness_m, &out.waviness_m}) {
    if (missing_in(*profile) < profile->size()) subtract_mean(*profile);
  }
  return out;
}

}  // namespace asperity
