#include "asperity/texture/fit_fourier2d.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_fourier2d.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "asperity/texture/synthesize_isotropic.h"
#include "fourier1d_extremes.h"

namespace asperity {
namespace {

void check_series(const Fourier1d& f) {
  if (f.a_m.size() != f.b_m.size() || f.a_m.empty()) {
    throw Error("texture: " + std::to_string(f.a_m.size()) + " cosine and " + std::to_string(f.b_m.size()) +
                " sine coefficients");
  }
  if (!(rms_height_m(f) > 0.0)) throw Error("texture: a flat profile gives no surface");
}

Fourier1d centred(Fourier1d f) {
  f.mean_m = 0.0;
  return f;
}

Fourier2d outer(const Fourier1d& x, const Fourier1d& y) {
  Fourier2d t;
  t.kind = Fourier2dKind::kOuter;
  t.x = centred(x);
  t.y = centred(y);
  t.offset_m = 0.5 * (x.mean_m + y.mean_m);
  t.scale_per_m = 1.0 / std::sqrt(rms_height_m(x) * rms_height_m(y));
  return t;
}

Fourier2d pattern(const Fourier1d& x, const Fourier1d& y) {
  const auto depth = [](const Fourier1d& f) {
    Fourier1d d = negated(f);
    d.mean_m += highest_height_m(f);
    return d;
  };
  Fourier2d t;
  t.kind = Fourier2dKind::kPattern;
  t.x = depth(x);
  t.y = depth(y);
  t.offset_m = std::max(highest_height_m(x), highest_height_m(y));
  t.scale_per_m = -1.0 / std::max(highest_height_m(t.x), highest_height_m(t.y));
  return t;
}

// The harmonics 1…N parted into bands: [first, end) each, a relative `resolution` wide.
// One harmonic's power scatters by 100 % from profile to profile, so that narrow bands would be noise.
std::vector<std::size_t> band_edges(std::size_t count, double resolution) {
  constexpr std::size_t kNarrowest = 3;
  std::vector<std::size_t> edges{1};
  while (edges.back() <= count) {
    const auto width = static_cast<std::size_t>(resolution * static_cast<double>(edges.back()));
    edges.push_back(std::min(count + 1, edges.back() + std::max(kNarrowest, width)));
  }
  return edges;
}

std::vector<double> band_means(const std::vector<double>& power, const std::vector<std::size_t>& edges) {
  std::vector<double> smooth(power.size());
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    double sum = 0.0;
    for (std::size_t j = edges[b]; j < edges[b + 1]; ++j) sum += power[j - 1];
    for (std::size_t j = edges[b]; j < edges[b + 1]; ++j)
      smooth[j - 1] = sum / static_cast<double>(edges[b + 1] - edges[b]);
  }
  return smooth;
}

// Richardson-Lucy: each band's power is multiplied by the mean, weighted by what it gives to each section
// harmonic, of wanted over present section power.
std::vector<double> surface_power_m2(const std::vector<double>& wanted, const std::vector<std::size_t>& edges,
                                     int iterations) {
  const std::size_t count = wanted.size();
  const std::size_t bands = edges.size() - 1;
  // What power 1 in a band gives to each section harmonic.
  std::vector<std::vector<double>> gives(bands);
  IsotropicSpectrum unit;
  for (std::size_t b = 0; b < bands; ++b) {
    unit.power_m2.assign(count, 0.0);
    std::fill(unit.power_m2.begin() + static_cast<std::ptrdiff_t>(edges[b]) - 1,
              unit.power_m2.begin() + static_cast<std::ptrdiff_t>(edges[b + 1]) - 1, 1.0);
    gives[b] = section_power_m2(unit);
  }
  double sum = 0.0;
  for (const double s : wanted) sum += s;
  std::vector<double> power(bands, sum), present(count);
  for (int i = 0; i < iterations; ++i) {
    std::fill(present.begin(), present.end(), 0.0);
    for (std::size_t b = 0; b < bands; ++b) {
      for (std::size_t m = 0; m < count; ++m) present[m] += power[b] * gives[b][m];
    }
    for (std::size_t b = 0; b < bands; ++b) {
      double ratio = 0.0;
      double weight = 0.0;
      for (std::size_t m = 0; m < count; ++m) {
        if (gives[b][m] == 0.0) continue;
        ratio += gives[b][m] * wanted[m] / std::max(present[m], sum * 1e-300);
        weight += gives[b][m];
      }
      power[b] *= ratio / weight;
    }
  }
  std::vector<double> result(count);
  for (std::size_t b = 0; b < bands; ++b) {
    for (std::size_t j = edges[b]; j < edges[b + 1]; ++j) result[j - 1] = power[b];
  }
  return result;
}

void fit_isotropic(const Fourier1d& x, const FitFourier2dConfig& config, Fourier2dFit& fit) {
  const std::size_t count =
      std::min({x.a_m.size(), static_cast<std::size_t>(config.coefficients), kMostIsotropicHarmonics});
  std::vector<double> source(count);
  for (std::size_t j = 0; j < count; ++j) source[j] = 0.5 * (x.a_m[j] * x.a_m[j] + x.b_m[j] * x.b_m[j]);
  const auto edges = band_edges(count, config.resolution);
  const auto wanted = band_means(source, edges);

  Fourier2d& t = fit.texture;
  t.kind = Fourier2dKind::kIsotropic;
  t.isotropic = {x.length_mm, surface_power_m2(wanted, edges, config.iterations), x.mean_m, config.seed};
  t.grid = synthesize_isotropic(t.isotropic);

  const auto sections = band_means(section_power_m2(t.isotropic), edges);
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t m = 0; m < count; ++m) difference += std::abs(sections[m] - wanted[m]), sum += wanted[m];
  fit.spectrum_error = difference / sum;
  if (fit.spectrum_error > 0.2) {
    fit.problems.push_back({"not_isotropic",
                            "the profile's spectrum is not that of an isotropic surface's sections: " +
                                number_text(std::round(100.0 * fit.spectrum_error)) + " % of its power is elsewhere",
                            1});
  }
}

// Of the surface about its mean, from its spectrum or its factors' moments.
double surface_rms_m(const Fourier2d& t) {
  if (t.kind == Fourier2dKind::kIsotropic) {
    double sum = 0.0;
    double square = 0.0;
    for (const double c : t.grid.coefficient_m) sum += c;
    const double n = static_cast<double>(t.grid.columns);
    const double mean = sum / (n * n);
    for (std::size_t r = 0; r < t.grid.rows; ++r) {
      for (std::size_t c = 0; c < t.grid.columns; ++c) {
        const double z = evaluate_height(t.grid, t.grid.spacing_x_m * static_cast<double>(c),
                                         t.grid.spacing_y_m * static_cast<double>(r))
                             .height_m -
                         mean;
        square += z * z;
      }
    }
    return std::sqrt(square / (n * n));
  }
  const double vx = std::pow(rms_height_m(t.x), 2);
  const double vy = std::pow(rms_height_m(t.y), 2);
  const double mx = t.x.mean_m * t.x.mean_m;
  const double my = t.y.mean_m * t.y.mean_m;
  return std::abs(t.scale_per_m) * std::sqrt((vx + mx) * (vy + my) - mx * my);
}

}  // namespace

Fourier2dFit fit_fourier2d(const Fourier1d& x, const Fourier1d& y, const FitFourier2dConfig& config, bool periodic) {
  check_series(x);
  check_series(y);
  Fourier2dFit fit;
  fit.source_rms_m = std::sqrt(rms_height_m(x) * rms_height_m(y));
  const auto automatic = periodic ? Fourier2dFitKind::kPattern : Fourier2dFitKind::kIsotropic;
  const Fourier2dFitKind kind = config.kind == Fourier2dFitKind::kAuto ? automatic : config.kind;
  if (kind == Fourier2dFitKind::kIsotropic) {
    fit.source_rms_m = rms_height_m(x);
    fit_isotropic(x, config, fit);
  } else {
    fit.texture = kind == Fourier2dFitKind::kOuter ? outer(x, y) : pattern(x, y);
  }
  fit.rms_height_m = surface_rms_m(fit.texture);
  fit.height_offset_m = -lowest_height_m(fit.texture);
  return fit;
}

}  // namespace asperity
