#include "stroke_samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/signal/spectrum.h"

namespace asperity {
namespace {

double length_mm(const AreaStroke& stroke) {
  return 1e3 * stroke.spacing_m * static_cast<double>(std::max<std::size_t>(stroke.height_m.size(), 1) - 1);
}

}  // namespace

std::vector<StrokeSample> thin_strokes(std::span<const AreaStroke> strokes, double step_mm) {
  std::vector<StrokeSample> out;
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const AreaStroke& stroke = strokes[k];
    const double spacing_mm = 1e3 * stroke.spacing_m;
    const auto block = static_cast<std::size_t>(std::max(1.0, std::round(step_mm / spacing_mm)));
    for (std::size_t begin = 0; begin < stroke.height_m.size(); begin += block) {
      const std::size_t end = std::min(begin + block, stroke.height_m.size());
      StrokeSample sample;
      double count = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        if (!std::isfinite(stroke.height_m[i])) continue;
        if (!std::isfinite(stroke.x_m[i]) || !std::isfinite(stroke.y_m[i]))
          throw Error("texture: stroke " + std::to_string(k + 1) + " has a height at a position that is not finite");
        sample.x_mm += 1e3 * stroke.x_m[i];
        sample.y_mm += 1e3 * stroke.y_m[i];
        sample.height_m += stroke.height_m[i];
        sample.s_mm += spacing_mm * static_cast<double>(i);
        count += 1.0;
      }
      if (2.0 * count < static_cast<double>(end - begin) || count == 0.0) continue;
      sample.x_mm /= count;
      sample.y_mm /= count;
      sample.height_m /= count;
      sample.s_mm /= count;
      sample.stroke = static_cast<std::uint32_t>(k);
      out.push_back(sample);
    }
  }
  return out;
}

DriftBasis make_drift_basis(std::span<const AreaStroke> strokes, double drift_mm) {
  DriftBasis out;
  out.knot_mm = 0.5 * drift_mm;
  out.first.push_back(0);
  for (const AreaStroke& stroke : strokes) {
    const auto hats = static_cast<std::uint32_t>(std::ceil(length_mm(stroke) / out.knot_mm)) + 1;
    out.first.push_back(out.first.back() + std::max<std::uint32_t>(hats, 2));
  }
  return out;
}

double detrend(std::vector<StrokeSample>& samples, const DriftBasis& basis) {
  double square = 0.0, count = 0.0;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin;
    while (end < samples.size() && samples[end].stroke == samples[begin].stroke) ++end;
    const std::uint32_t k = samples[begin].stroke;
    const auto hats = static_cast<Eigen::Index>(basis.first[k + 1] - basis.first[k]);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(hats, hats);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(hats);
    const auto hat = [&](double s_mm, Eigen::Index& i, double& share) {
      i = std::min(static_cast<Eigen::Index>(s_mm / basis.knot_mm), hats - 2);
      share = s_mm / basis.knot_mm - static_cast<double>(i);
    };
    for (std::size_t m = begin; m < end; ++m) {
      Eigen::Index i = 0;
      double share = 0.0;
      hat(samples[m].s_mm, i, share);
      normal(i, i) += (1 - share) * (1 - share);
      normal(i, i + 1) += share * (1 - share);
      normal(i + 1, i) += share * (1 - share);
      normal(i + 1, i + 1) += share * share;
      right[i] += (1 - share) * samples[m].height_m;
      right[i + 1] += share * samples[m].height_m;
    }
    // Hats without samples keep to their neighbours.
    for (Eigen::Index i = 0; i + 1 < hats; ++i) {
      const double w = 1e-3;
      normal(i, i) += w;
      normal(i + 1, i + 1) += w;
      normal(i, i + 1) -= w;
      normal(i + 1, i) -= w;
    }
    const Eigen::VectorXd course = solve_symmetric(normal, right);
    for (std::size_t m = begin; m < end; ++m) {
      Eigen::Index i = 0;
      double share = 0.0;
      hat(samples[m].s_mm, i, share);
      samples[m].texture_m = samples[m].height_m - (1 - share) * course[i] - share * course[i + 1];
    }
    square += (course.array() - course.mean()).square().sum();
    count += static_cast<double>(hats - 1);
    begin = end;
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

StrokeSpectrum measure_strokes(std::span<const AreaStroke> strokes, double drift_mm, double part) {
  StrokeSpectrum out;
  double runs = 0.0;
  std::vector<double> sum, frequency;
  for (const AreaStroke& stroke : strokes) {
    const double rate_per_mm = 1e-3 / stroke.spacing_m;
    const auto segment = static_cast<std::size_t>(std::round(drift_mm * rate_per_mm));
    for (std::size_t begin = 0; begin < stroke.height_m.size();) {
      std::size_t end = begin;
      while (end < stroke.height_m.size() && std::isfinite(stroke.height_m[end])) ++end;
      if (end - begin >= segment && segment >= 16) {
        const PowerSpectrum spectrum =
            welch(std::span(stroke.height_m).subspan(begin, end - begin), rate_per_mm, segment);
        if (sum.empty()) {
          sum.assign(spectrum.density.size(), 0.0);
          frequency = spectrum.frequency;
        }
        // Strokes of one spacing have the same frequencies.
        if (spectrum.density.size() == sum.size()) {
          const auto weight = static_cast<double>(spectrum.segments);
          for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * spectrum.density[i];
          runs += weight;
        }
      }
      begin = std::max(end, begin + 1);
    }
  }
  if (runs == 0.0) return out;
  // What the upper half of the frequencies has is noise, and white: waves that short are no surface under a tip.
  std::vector<double> upper(sum.begin() + static_cast<std::ptrdiff_t>(sum.size() / 2), sum.end());
  std::nth_element(upper.begin(), upper.begin() + static_cast<std::ptrdiff_t>(upper.size() / 2), upper.end());
  const double floor = upper[upper.size() / 2];
  constexpr double kLeastShare = 0.05;  // of a frequency's power is the surface's
  for (double& density : sum) density = std::max(density - floor, kLeastShare * density);
  const double lowest = 1.9 / drift_mm;
  double all = 0.0, so_far = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) all += frequency[i] >= lowest ? sum[i] : 0.0;
  for (std::size_t i = 0; i < sum.size() && so_far < part * all; ++i) {
    if (frequency[i] < lowest) continue;
    so_far += sum[i];
    out.frequency_cycles_per_mm.push_back(frequency[i]);
    out.density_m2mm.push_back(std::max(sum[i] / runs, 1e-30));
  }
  return out;
}

std::size_t count_ties(const std::vector<StrokeSample>& samples, double reach_mm) {
  const auto cell = [&](double v_mm) { return static_cast<std::int64_t>(std::floor(v_mm / reach_mm)); };
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> cells;
  for (std::uint32_t i = 0; i < samples.size(); ++i) cells[{cell(samples[i].x_mm), cell(samples[i].y_mm)}].push_back(i);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const StrokeSample& a : samples) {
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto found = cells.find({cell(a.x_mm) + dx, cell(a.y_mm) + dy});
        if (found == cells.end()) continue;
        for (const std::uint32_t j : found->second) {
          const StrokeSample& b = samples[j];
          if (b.stroke > a.stroke && std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm) <= reach_mm)
            pairs.emplace(a.stroke, b.stroke);
        }
      }
    }
  }
  return pairs.size();
}

}  // namespace asperity
