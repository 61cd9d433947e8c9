#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/signal/spectrum.h"
#include "local_slopes.h"
#include "material_curve.h"
#include "probability_curve.h"
#include "profile_features.h"

namespace asperity {
namespace {

struct Extremes {
  double peak = -std::numeric_limits<double>::infinity();
  double pit = -std::numeric_limits<double>::infinity();  // depth
  std::size_t count = 0;
};

Extremes extremes_of(std::span<const double> z) {
  Extremes out;
  for (const double v : z) {
    if (std::isnan(v)) continue;
    out.peak = std::max(out.peak, v);
    out.pit = std::max(out.pit, -v);
    ++out.count;
  }
  return out;
}

void measure_moments(std::span<const double> z, ProfileParametersResult& out) {
  double sum1 = 0.0, sum2 = 0.0, sum3 = 0.0, sum4 = 0.0;
  for (const double v : z) {
    if (std::isnan(v)) continue;
    sum1 += std::abs(v);
    sum2 += v * v;
    sum3 += v * v * v;
    sum4 += v * v * v * v;
  }
  const double count = static_cast<double>(out.samples - out.missing);
  out.a_m = sum1 / count;
  out.q_m = std::sqrt(sum2 / count);
  if (out.q_m == 0.0) return;
  out.sk = sum3 / count / std::pow(out.q_m, 3);
  out.ku = sum4 / count / std::pow(out.q_m, 4);
}

void measure_sections(std::span<const double> z, std::size_t sections, double max_missing,
                      ProfileParametersResult& out) {
  double peaks = 0.0, pits = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < sections; ++i) {
    const std::size_t start = i * z.size() / sections;
    const auto section = z.subspan(start, (i + 1) * z.size() / sections - start);
    const Extremes here = extremes_of(section);
    if (here.count < 2 ||
        static_cast<double>(section.size() - here.count) > max_missing * static_cast<double>(section.size()))
      continue;
    peaks += here.peak;
    pits += here.pit;
    largest = std::max(largest, here.peak + here.pit);
    ++out.sections_used;
  }
  if (out.sections_used == 0) return;
  out.p_m = peaks / static_cast<double>(out.sections_used);
  out.v_m = pits / static_cast<double>(out.sections_used);
  out.z_m = out.p_m + out.v_m;
  out.zx_m = largest;
}

void measure_elements(std::span<const double> z, double spacing_m, double section_m, const RoughnessConfig& config,
                      ProfileParametersResult& out) {
  if (!(out.z_m > 0.0)) return;
  ElementWidths all;
  for (const auto stretch : gap_free_stretches(z)) {
    const auto more =
        element_widths(stretch, spacing_m, config.element_height * out.z_m, config.element_width * section_m);
    all.add(more);
  }
  out.elements = all.count;
  if (all.count == 0) return;
  const auto count = static_cast<double>(all.count);
  out.sm_m = all.sum_m / count;
  out.pc_per_m = 1.0 / out.sm_m;
  out.smx_m = all.widest_m;
  out.smq_m = std::sqrt(std::max(0.0, all.sum_square_m2 / count - out.sm_m * out.sm_m));
  out.c_m = all.sum_height_m / count;
  out.cx_m = all.highest_m;
  out.cq_m = std::sqrt(std::max(0.0, all.sum_square_height_m2 / count - out.c_m * out.c_m));
}

// The second derivative, of sixth order where three heights are present on either side (Fornberg 1988).
double curvature_at(std::span<const double> stretch, const double* at, double spacing_m) {
  const double before = static_cast<double>(at - stretch.data());
  const double behind = static_cast<double>(stretch.size()) - 1.0 - before;
  if (before < 1.0 || behind < 1.0) return kNan;
  if (before < 3.0 || behind < 3.0) return (at[-1] - 2.0 * at[0] + at[1]) / (spacing_m * spacing_m);
  return (2.0 * (at[-3] + at[3]) - 27.0 * (at[-2] + at[2]) + 270.0 * (at[-1] + at[1]) - 490.0 * at[0]) /
         (180.0 * spacing_m * spacing_m);
}

double mean_of_first(std::vector<double> values, std::size_t count) {
  if (values.empty()) return kNan;
  count = std::min(count, values.size());
  std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count), values.end(),
                    std::greater<>{});
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

void measure_peaks(std::span<const double> z, double spacing_m, const RoughnessConfig& config,
                   ProfileParametersResult& out) {
  if (!(out.z_m > 0.0)) return;
  std::vector<double> peaks, pits;
  double peak_curvature = 0.0, pit_curvature = 0.0, curved_peaks = 0.0, curved_pits = 0.0;
  for (const auto stretch : gap_free_stretches(z)) {
    PeaksAndPits found;
    append_peaks_and_pits(stretch, config.peak_prominence * out.z_m, found);
    peaks.insert(peaks.end(), found.peak_m.begin(), found.peak_m.end());
    for (const double pit : found.pit_m) pits.push_back(-pit);
    const auto add = [&](const std::vector<const double*>& at, double sign, double& sum, double& count) {
      for (const double* sample : at) {
        const double curvature = curvature_at(stretch, sample, spacing_m);
        if (std::isnan(curvature)) continue;
        sum += sign * curvature;
        count += 1.0;
      }
    };
    add(found.peak, -1.0, peak_curvature, curved_peaks);
    add(found.pit, 1.0, pit_curvature, curved_pits);
  }
  const double present_m = static_cast<double>(out.samples - out.missing) * spacing_m;
  out.pd_per_m = static_cast<double>(peaks.size()) / present_m;
  out.vd_per_m = static_cast<double>(pits.size()) / present_m;
  if (curved_peaks > 0.0) out.mpc_per_m = peak_curvature / curved_peaks;
  if (curved_pits > 0.0) out.mvc_per_m = pit_curvature / curved_pits;
  constexpr std::size_t kFive = 5;
  out.five_p_m = mean_of_first(std::move(peaks), kFive);
  out.five_v_m = mean_of_first(std::move(pits), kFive);
  out.ten_z_m = out.five_p_m + out.five_v_m;
}

void measure_slopes(std::span<const double> z, double spacing_m, ProfileParametersResult& out) {
  double sum1 = 0.0, sum2 = 0.0, longer = 0.0, steepest = 0.0, count = 0.0;
  for (const double slope : local_slopes(z, spacing_m)) {
    if (std::isnan(slope)) continue;
    const double square = slope * slope;
    sum1 += std::abs(slope);
    sum2 += square;
    longer += square / (std::sqrt(1.0 + square) + 1.0);  // √(1 + s²) − 1
    steepest = std::max(steepest, std::abs(slope));
    count += 1.0;
  }
  if (count == 0.0) return;
  out.da = sum1 / count;
  out.dq = std::sqrt(sum2 / count);
  out.dr = longer / count;
  out.dt = steepest;
  out.dl_m = (1.0 + out.dr) * out.length_m;
}

// Of the largest line of the periodogram (Hann), between lines by the parabola through the logarithms of the three
// largest. Missing heights are on the mean line.
double dominant_wavelength_m(std::span<const double> z, double spacing_m) {
  constexpr std::size_t kLeast = 8;
  if (z.size() < kLeast) return kNan;
  std::vector<double> filled(z.begin(), z.end());
  for (double& v : filled)
    if (std::isnan(v)) v = 0.0;
  const PowerSpectrum spectrum = welch(filled, 1.0 / spacing_m, filled.size());
  const std::vector<double>& density = spectrum.density;
  const auto at = static_cast<std::size_t>(std::max_element(density.begin() + 1, density.end()) - density.begin());
  if (!(density[at] > 0.0)) return kNan;
  double line = static_cast<double>(at);
  if (at > 1 && at + 1 < density.size() && density[at - 1] > 0.0 && density[at + 1] > 0.0) {
    const double a = std::log(density[at - 1]), b = std::log(density[at]), c = std::log(density[at + 1]);
    if (a - 2.0 * b + c < 0.0) line += 0.5 * (a - c) / (a - 2.0 * b + c);
  }
  return 1.0 / (line * (spectrum.frequency[1] - spectrum.frequency[0]));
}

// Where Σ z_i z_{i+k} over the pairs present, a pair, over the same at k = 0, first falls to 0.2; lags up to half of
// the length.
double autocorrelation_length_m(std::span<const double> z, double spacing_m) {
  constexpr double kThreshold = 0.2;
  const std::size_t n = z.size(), padded = 2 * n;
  std::vector<double> heights(padded, 0.0), present(padded, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(z[i])) continue;
    heights[i] = z[i];
    present[i] = 1.0;
  }
  const auto correlated = [&](const std::vector<double>& x) {
    auto half = real_dft(x);
    for (auto& v : half) v = std::norm(v);
    return inverse_real_dft(half, padded);
  };
  const std::vector<double> products = correlated(heights), pairs = correlated(present);
  const double variance = products[0] / pairs[0];
  if (!(variance > 0.0)) return kNan;
  double before = 1.0;
  for (std::size_t lag = 1; 2 * lag <= n; ++lag) {
    if (pairs[lag] < 0.5) return kNan;
    const double here = products[lag] / pairs[lag] / variance;
    if (here <= kThreshold) return spacing_m * (static_cast<double>(lag) - (kThreshold - here) / (before - here));
    before = here;
  }
  return kNan;
}

void measure_material(std::span<const double> z, const MaterialRatioConfig& config, ProfileParametersResult& out) {
  const MaterialCurve curve(z);
  const MaterialCore core = curve.core();
  out.mr = curve.ratio_above(1e-6 * config.level_um);
  out.dc_m = curve.level(config.upper_ratio) - curve.level(config.lower_ratio);
  out.k_m = core.k;
  out.pk_m = core.pk;
  out.vk_m = core.vk;
  out.mrk1 = core.ratio1;
  out.mrk2 = core.ratio2;
  constexpr double kPeaks = 0.1, kPits = 0.8;  // ISO 25178-2's, which ISO 21920-2 took over
  out.vmp_m = curve.material_volume(kPeaks);
  out.vmc_m = curve.material_volume(kPits) - out.vmp_m;
  out.vvv_m = curve.void_volume(kPits);
  out.vvc_m = curve.void_volume(kPeaks) - out.vvv_m;
  if (const auto two = fit_probability_curve(curve)) {
    out.pq_m = two->plateau;
    out.vq_m = two->pits;
    out.mq = two->ratio;
  }
}

}  // namespace

ProfileParametersResult measure_profile_parameters(std::span<const double> z_m, double spacing_m, int sections,
                                                   const RoughnessConfig& config, const MaterialRatioConfig& material) {
  const Extremes all = extremes_of(z_m);
  if (all.count < 2 || sections < 1) throw Error("roughness: a profile of fewer than two heights");
  ProfileParametersResult out;
  out.samples = z_m.size();
  out.missing = z_m.size() - all.count;
  out.length_m = static_cast<double>(z_m.size()) * spacing_m;
  out.pt_m = all.peak;
  out.vt_m = all.pit;
  out.t_m = all.peak + all.pit;
  measure_moments(z_m, out);
  measure_sections(z_m, static_cast<std::size_t>(sections), config.max_missing, out);
  measure_elements(z_m, spacing_m, out.length_m / sections, config, out);
  measure_peaks(z_m, spacing_m, config, out);
  measure_slopes(z_m, spacing_m, out);
  out.sw_m = dominant_wavelength_m(z_m, spacing_m);
  out.al_m = autocorrelation_length_m(z_m, spacing_m);
  measure_material(z_m, material, out);
  return out;
}

}  // namespace asperity
