#include "asperity/profile/measure_roughness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/radix_sort.h"
#include "asperity/base/text.h"
#include "asperity/profile/filter_profile.h"
#include "profile_features.h"

namespace asperity {
namespace {

std::size_t count_missing(std::span<const double> z) {
  return static_cast<std::size_t>(std::count_if(z.begin(), z.end(), [](double v) { return std::isnan(v); }));
}

// Highest minus lowest of the present samples.
double range_m(std::span<const double> z) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double v : z) {
    if (std::isnan(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return high - low;
}

void measure_heights(std::span<const double> z, RoughnessResult& result) {
  double sum1 = 0.0, sum2 = 0.0, sum3 = 0.0, sum4 = 0.0;
  for (const double v : z) {
    if (std::isnan(v)) continue;
    const double square = v * v;
    sum1 += std::abs(v);
    sum2 += square;
    sum3 += square * v;
    sum4 += square * square;
  }
  const double count = static_cast<double>(result.samples - result.missing);
  result.Ra_m = sum1 / count;
  result.Rq_m = std::sqrt(sum2 / count);
  result.Rt_m = range_m(z);
  const bool flat = result.Rq_m == 0.0;
  result.Rsk = flat ? kNan : sum3 / count / (result.Rq_m * result.Rq_m * result.Rq_m);
  result.Rku = flat ? kNan : sum4 / count / (result.Rq_m * result.Rq_m * result.Rq_m * result.Rq_m);
}

void measure_sections(std::span<const double> z, const RoughnessConfig& config, RoughnessResult& result) {
  const auto sections = static_cast<std::size_t>(config.sections);
  double sum = 0.0;
  for (std::size_t i = 0; i < sections; ++i) {
    const std::size_t start = i * z.size() / sections;
    const auto section = z.subspan(start, (i + 1) * z.size() / sections - start);
    const std::size_t missing = count_missing(section);
    if (missing + 2 > section.size() ||
        static_cast<double>(missing) > config.max_missing * static_cast<double>(section.size()))
      continue;
    sum += range_m(section);
    ++result.sections_used;
  }
  result.Rz_m = result.sections_used > 0 ? sum / static_cast<double>(result.sections_used) : kNan;
}

// The mean of the five values that come first by `before`, or of all if there are fewer.
template <class Before>
double mean_of_five(std::vector<double> values, const Before& before) {
  if (values.empty()) return kNan;
  const std::size_t count = std::min<std::size_t>(5, values.size());
  std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count), values.end(), before);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

void measure_features(std::span<const double> z, double spacing_m, const RoughnessConfig& config,
                      RoughnessResult& result, const Observer& observer) {
  result.RSm_m = result.R5p_m = result.R5v_m = result.R10z_m = kNan;
  if (!(result.Rz_m > 0.0)) return;
  ElementWidths widths;
  PeaksAndPits found;
  const double min_width_m = config.element_width * result.length_m / static_cast<double>(config.sections);
  for (const auto stretch : gap_free_stretches(z)) {
    const auto more = element_widths(stretch, spacing_m, config.element_height * result.Rz_m, min_width_m, observer);
    widths.sum_m += more.sum_m;
    widths.count += more.count;
    append_peaks_and_pits(stretch, config.peak_prominence * result.Rz_m, found, observer);
  }
  result.elements = widths.count;
  if (widths.count > 0) result.RSm_m = widths.sum_m / static_cast<double>(widths.count);
  result.R5p_m = mean_of_five(std::move(found.peak_m), std::greater<>{});
  result.R5v_m = -mean_of_five(std::move(found.pit_m), std::less<>{});
  result.R10z_m = result.R5p_m + result.R5v_m;
}

double material_ratio_level_m(const std::vector<double>& descending_m, double percent) {
  const double n = static_cast<double>(descending_m.size());
  // k / n ≥ p, where rounding of p n must not skip the sample that meets it exactly.
  const double k = std::clamp(std::ceil(percent / 100.0 * n - 1e-9), 1.0, n);
  return descending_m[static_cast<std::size_t>(k) - 1] - descending_m.front();
}

std::vector<double> descending(std::span<const double> height_m) {
  std::vector<double> sorted;
  sorted.reserve(height_m.size());
  std::copy_if(height_m.begin(), height_m.end(), std::back_inserter(sorted), [](double v) { return !std::isnan(v); });
  sort_falling(sorted);
  return sorted;
}

}  // namespace

std::vector<double> roughness_profile_m(std::span<const double> height_m, double spacing_m,
                                        const RoughnessConfig& config) {
  return filter_profile(height_m, spacing_m, config).roughness_m;
}

RoughnessResult measure_roughness(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config,
                                  const Observer& observer) {
  observer.update("roughness", 0.0);
  const auto z = filter_profile(height_m, spacing_m, config, observer).roughness_m;
  observer.update("roughness", 0.5);
  RoughnessResult result;
  result.samples = z.size();
  result.missing = count_missing(z);
  result.length_m = static_cast<double>(z.size()) * spacing_m;
  measure_heights(z, result);
  measure_sections(z, config, result);
  measure_features(z, spacing_m, config, result, observer);
  observer.update("roughness", 0.9);
  const auto sorted = descending(z);
  result.Rcm10_m = material_ratio_level_m(sorted, 10.0);
  result.Rcm50_m = material_ratio_level_m(sorted, 50.0);
  result.Rcm90_m = material_ratio_level_m(sorted, 90.0);
  return result;
}

double inverse_material_ratio_m(std::span<const double> height_m, double percent) {
  if (!(percent >= 0.0 && percent <= 100.0))
    throw Error("roughness: a material ratio of " + number_text(percent) + " % is not within 0 and 100");
  const auto sorted = descending(height_m);
  if (sorted.empty()) throw Error("roughness: a material ratio of no heights");
  return material_ratio_level_m(sorted, percent);
}

}  // namespace asperity
