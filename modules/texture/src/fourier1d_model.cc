#include "asperity/texture/fourier1d_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/low_pass_texture.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"
#include "fourier1d_extremes.h"
#include "fourier_tables.h"

namespace asperity {

using Traits1d = TextureModelTraits<Fourier1d>;

Json Traits1d::describe(const Fourier1d& f) {
  return {{"length_mm", f.length_mm}, {"harmonics", f.a_m.size()}, {"mean_m", f.mean_m}};
}

void Traits1d::scale(Fourier1d& f, double factor) {
  for (double& a : f.a_m) a *= factor;
  for (double& b : f.b_m) b *= factor;
  f.mean_m *= factor;
}

void Traits1d::add_to(TextureHash& hash, const Fourier1d& f) { hash.add(f.length_mm, f.mean_m, f.a_m, f.b_m); }

void Traits1d::low_pass(Fourier1d& f, double cutoff_cycles_per_mm) {
  std::size_t kept = 0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const double gain = low_pass_gain(static_cast<double>(j + 1) / f.length_mm, cutoff_cycles_per_mm);
    f.a_m[j] *= gain;
    f.b_m[j] *= gain;
    if (gain > 0.0) kept = j + 1;
  }
  // A series without harmonics is no texture to most: one is left, if only at zero.
  kept = std::min(std::max<std::size_t>(kept, 1), f.a_m.size());
  f.a_m.resize(kept);
  f.b_m.resize(kept);
}

HeightAndGradient Traits1d::height(const Fourier1d& f, double x_m, double) noexcept {
  const HeightAndSlope h = evaluate_height(f, x_m);
  return {h.height_m, h.slope, 0.0};
}

double Traits1d::lowest_m(const Fourier1d& f) { return lowest_height_m(f); }
double Traits1d::highest_m(const Fourier1d& f) { return -lowest_height_m(negated(f)); }
HeightPeriods Traits1d::periods_m(const Fourier1d& f) { return {f.length_mm * 1e-3, 0.0}; }
double Traits1d::length_mm(const Fourier1d& f) { return f.length_mm; }

HeightWindow Traits1d::window(const Fourier1d& f, std::size_t) {
  HeightWindow out;
  out.length_m = out.width_m = f.length_mm * 1e-3;
  out.columns = 4 * std::max<std::size_t>(f.a_m.size(), 1);
  return out;
}

double Traits1d::highest_cycles_per_mm(const Fourier1d& f) { return static_cast<double>(f.a_m.size()) / f.length_mm; }

void Traits1d::make_tables(const Fourier1d& f, ServoTables& tables) {
  const SeriesSize size = size_of(f);
  tables.x_table = make_periodic_table(f, kTableHeightError * size.rms_m, kTableSlopeError * size.rms_slope);
}

Fourier1d fit_series(const TextureFitInput& input, const std::vector<std::string>& files,
                     const TextureFitOptions& options, FittedTexture& out) {
  const HeightLine profile = input.read_heights(files);
  out.texture.roughness = input.roughness({profile.height_m}, profile.spacing_m);
  const double nyquist = 0.5e-3 / profile.spacing_m;
  Fourier1d series;
  if (input.whole_path) {
    FourierPathFit path = fit_fourier1d_path(profile.height_m, profile.spacing_m, options.of<Fourier1d>().path);
    out.report["rms_height_m"] = path.fit.rms_height_m;
    out.report["rms_error_m"] = path.fit.rms_error_m;
    out.report["relative_residual"] = path.fit.relative_residual;
    out.add_problems(path.problems);
    series = std::move(path.fit.texture);
  } else {
    FourierFit window =
        fit_fourier1d(profile.height_m, profile.spacing_m, options.of<Fourier1d>().fourier1d, input.observer);
    out.report["first_sample"] = window.first_sample;
    out.report["samples"] = window.samples;
    out.report["bridged"] = window.bridged;
    out.report["rms_height_m"] = window.rms_height_m;
    out.report["rms_error_m"] = window.rms_error_m;
    out.add_problems(window.problems);
    series = std::move(window.texture);
  }
  out.texture.band_cycles_per_mm = {0.0, std::min(nyquist, Traits1d::highest_cycles_per_mm(series))};
  return series;
}

void Traits1d::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  out.texture.model = fit_series(input, input.files, options, out);
}

}  // namespace asperity
