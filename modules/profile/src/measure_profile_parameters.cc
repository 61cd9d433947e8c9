#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/signal/spectrum.h"
#include "local_slopes.h"
#include "material_curve.h"
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
    all.sum_m += more.sum_m;
    all.count += more.count;
    all.sum_height_m += more.sum_height_m;
    all.highest_m = std::max(all.highest_m, more.highest_m);
  }
  out.elements = all.count;
  if (all.count == 0) return;
  out.sm_m = all.sum_m / static_cast<double>(all.count);
  out.pc_per_m = 1.0 / out.sm_m;
  out.c_m = all.sum_height_m / static_cast<double>(all.count);
  out.cx_m = all.highest_m;
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
  measure_slopes(z_m, spacing_m, out);
  out.al_m = autocorrelation_length_m(z_m, spacing_m);
  measure_material(z_m, material, out);
  return out;
}

}  // namespace asperity
