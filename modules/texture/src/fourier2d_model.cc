#include "asperity/texture/fourier2d_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/texture/evaluate_fourier2d.h"
#include "asperity/texture/fourier1d_model.h"
#include "asperity/texture/low_pass_texture.h"
#include "asperity/texture/synthesize_isotropic.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"
#include "fourier_tables.h"
#include "spline_grid_model.h"

namespace asperity {

using Traits2d = TextureModelTraits<Fourier2d>;

Json Traits2d::describe(const Fourier2d& t) {
  Json out;
  out["kind"] = kFourier2dKindNames.at(static_cast<std::size_t>(t.kind));
  if (t.kind == Fourier2dKind::kIsotropic) {
    out["length_mm"] = t.isotropic.length_mm;
    out["harmonics"] = t.isotropic.power_m2.size();
    out["seed"] = t.isotropic.seed;
  } else {
    using Factor = TextureModelTraits<Fourier1d>;
    out["x"] = Factor::describe(t.x);
    out["y"] = Factor::describe(t.y);
  }
  return out;
}

void Traits2d::scale(Fourier2d& t, double factor) {
  t.scale_per_m *= factor;
  t.offset_m *= factor;
  for (double& power : t.isotropic.power_m2) power *= factor * factor;
  t.isotropic.mean_m *= factor;
  for (double& c : t.grid.coefficient_m) c *= factor;
}

void Traits2d::add_to(TextureHash& hash, const Fourier2d& t) {
  hash.add(static_cast<std::uint64_t>(t.kind));
  TextureModelTraits<Fourier1d>::add_to(hash, t.x);
  TextureModelTraits<Fourier1d>::add_to(hash, t.y);
  hash.add(t.scale_per_m, t.offset_m);
  add_grid_to(hash, t.grid);
}

void Traits2d::low_pass(Fourier2d& t, double cutoff_cycles_per_mm) {
  if (t.kind != Fourier2dKind::kIsotropic) {
    TextureModelTraits<Fourier1d>::low_pass(t.x, cutoff_cycles_per_mm);
    TextureModelTraits<Fourier1d>::low_pass(t.y, cutoff_cycles_per_mm);
    return;
  }
  IsotropicSpectrum& spectrum = t.isotropic;
  for (std::size_t j = 0; j < spectrum.power_m2.size(); ++j) {
    const double gain = low_pass_gain(static_cast<double>(j + 1) / spectrum.length_mm, cutoff_cycles_per_mm);
    spectrum.power_m2[j] *= gain * gain;
  }
  t.grid = synthesize_isotropic(spectrum);
}

bool Traits2d::reseed(Fourier2d& t, std::int64_t seed) {
  if (t.kind != Fourier2dKind::kIsotropic) return false;
  t.isotropic.seed = seed;
  t.grid = synthesize_isotropic(t.isotropic);
  return true;
}

HeightAndGradient Traits2d::height(const Fourier2d& t, double x_m, double y_m) noexcept {
  return evaluate_height(t, x_m, y_m);
}
double Traits2d::lowest_m(const Fourier2d& t) { return lowest_height_m(t); }

double Traits2d::highest_m(const Fourier2d& t) {
  Fourier2d upside_down = t;
  upside_down.scale_per_m = -t.scale_per_m;
  upside_down.offset_m = -t.offset_m;
  for (double& c : upside_down.grid.coefficient_m) c = -c;
  return -lowest_height_m(upside_down);
}

HeightPeriods Traits2d::periods_m(const Fourier2d& t) {
  if (t.kind == Fourier2dKind::kIsotropic) return {1e-3 * t.isotropic.length_mm, 1e-3 * t.isotropic.length_mm};
  return {1e-3 * t.x.length_mm, 1e-3 * t.y.length_mm};
}

HeightWindow Traits2d::window(const Fourier2d& t, std::size_t most_cells) {
  HeightWindow out;
  const HeightPeriods periods = periods_m(t);
  out.length_m = periods.x_m;
  out.width_m = periods.y_m;
  if (t.kind == Fourier2dKind::kIsotropic) {
    out.columns = t.grid.columns;
    out.rows = t.grid.rows;
  } else {
    out.columns = TextureModelTraits<Fourier1d>::window(t.x, most_cells).columns;
    out.rows = TextureModelTraits<Fourier1d>::window(t.y, most_cells).columns;
  }
  return out;
}

double Traits2d::highest_cycles_per_mm(const Fourier2d& t) {
  using Factor = TextureModelTraits<Fourier1d>;
  if (t.kind != Fourier2dKind::kIsotropic)
    return std::max(Factor::highest_cycles_per_mm(t.x), Factor::highest_cycles_per_mm(t.y));
  return static_cast<double>(t.isotropic.power_m2.size()) / t.isotropic.length_mm;
}

// With x = X + ex and y = Y + ey, the product errs by |X| ey + |Y| ex, its slope along x by |X'| ey + |Y| ex'.
// Each of the two terms gets half.
void Traits2d::make_tables(const Fourier2d& t, ServoTables& tables) {
  if (t.kind == Fourier2dKind::kIsotropic) {
    tables.grid = grid_scale(t.grid);
    return;
  }
  const SeriesSize x = size_of(t.x);
  const SeriesSize y = size_of(t.y);
  const double mean_square_x = x.mean * x.mean + x.rms_m * x.rms_m;
  const double mean_square_y = y.mean * y.mean + y.rms_m * y.rms_m;
  // Of X Y about its mean, and of its slopes.
  const double rms = std::sqrt(mean_square_x * mean_square_y - x.mean * x.mean * y.mean * y.mean);
  const double rms_slope_x = x.rms_slope * std::sqrt(mean_square_y);
  const double rms_slope_y = y.rms_slope * std::sqrt(mean_square_x);
  const auto share = [](double error, double most) {
    return most > 0.0 ? 0.5 * error / most : std::numeric_limits<double>::infinity();
  };
  const auto table = [&](const Fourier1d& g, const SeriesSize& other, double own_slope, double other_slope) {
    const double height =
        std::min(share(kTableHeightError * rms, other.most_m), share(kTableSlopeError * other_slope, other.most_slope));
    return make_periodic_table(g, height, share(kTableSlopeError * own_slope, other.most_m));
  };
  tables.x_table = table(t.x, y, rms_slope_x, rms_slope_y);
  tables.y_table = table(t.y, x, rms_slope_y, rms_slope_x);
  if (tables.x_table.cells.empty() || tables.y_table.cells.empty()) tables.x_table = tables.y_table = {};
}

void Traits2d::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  if (input.files.size() > 2) throw TextureFitFilesError("fourier2d takes one profile, or one along x and one along y");
  const FitFourier2dConfig& config = options.of<Fourier2d>().fourier2d;
  // A profile that repeats gives a pattern, which closes if the series holds whole periods.
  bool periodic = config.kind == Fourier2dFitKind::kAuto && input.pitch_m != nullptr;
  const auto fit_axis = [&](const std::string& file, FittedTexture& axis) {
    TextureFitOptions own = options;
    if (periodic) {
      const double pitch_m = input.pitch_m({file});
      periodic = pitch_m > 0.0;
      if (periodic) {
        axis.report["pitch_m"] = pitch_m;
        double& length_mm = std::get<TextureModelTraits<Fourier1d>::FitOptions>(own.all).fourier1d.length_mm;
        length_mm = 1e3 * pitch_m * std::max(1.0, std::round(length_mm / (1e3 * pitch_m)));
      }
    }
    return fit_series(input, {file}, own, axis);
  };
  const Fourier1d x = fit_axis(input.files.front(), out);
  FittedTexture across;
  const Fourier1d y = input.files.size() == 2 ? fit_axis(input.files.back(), across) : x;
  if (across.report.contains("pitch_m")) out.report["pitch_across_m"] = across.report["pitch_m"];
  Fourier2dFit fit = fit_fourier2d(x, y, config, periodic);
  out.report["kind"] = kFourier2dKindNames.at(static_cast<std::size_t>(fit.texture.kind));
  out.report["surface_rms_m"] = fit.rms_height_m;
  out.report["source_rms_m"] = fit.source_rms_m;
  if (fit.texture.kind == Fourier2dKind::kIsotropic) out.report["spectrum_error"] = fit.spectrum_error;
  out.add_problems(across.problems);
  out.add_problems(fit.problems);
  out.texture.model = std::move(fit.texture);
}

}  // namespace asperity
