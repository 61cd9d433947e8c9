#include "asperity/texture/fit_areal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "areal_system.h"
#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

constexpr std::size_t kMostASide = 4096;
constexpr std::size_t kMostNodes = 1 << 22;
constexpr double kSolveTolerance = 1e-8;

struct Extent {
  double low_x = std::numeric_limits<double>::infinity();
  double high_x = -low_x;
  double low_y = low_x;
  double high_y = -low_x;
};

Extent extent_of(std::span<const ArealSample> samples) {
  Extent e;
  for (const auto& s : samples) {
    e.low_x = std::min(e.low_x, s.x_m);
    e.high_x = std::max(e.high_x, s.x_m);
    e.low_y = std::min(e.low_y, s.y_m);
    e.high_y = std::max(e.high_y, s.y_m);
  }
  return e;
}

std::vector<ArealSample> checked(std::span<const ArealSample> samples, Problems& problems) {
  std::vector<ArealSample> present;
  present.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& s = samples[i];
    if (!std::isfinite(s.x_m) || !std::isfinite(s.y_m) || std::isinf(s.height_m)) {
      throw Error("texture: sample " + std::to_string(i + 1) + " at (" + number_text(s.x_m) + ", " +
                  number_text(s.y_m) + ") m with height " + number_text(s.height_m) + " m is not finite");
    }
    constexpr double kFurthest_m = 1e6;
    if (std::abs(s.x_m) > kFurthest_m || std::abs(s.y_m) > kFurthest_m || std::abs(s.height_m) > kPlausibleHeight_m) {
      throw Error("texture: sample " + std::to_string(i + 1) + " at (" + number_text(s.x_m) + ", " +
                  number_text(s.y_m) + ") m with height " + number_text(s.height_m) + " m is not plausible");
    }
    if (!std::isnan(s.height_m)) present.push_back(s);
  }
  if (present.size() < 16) throw Error("texture: " + std::to_string(present.size()) + " heights; a surface needs 16");
  if (const std::size_t missing = samples.size() - present.size(); missing > 0)
    problems.push_back({"missing_heights", std::to_string(missing) + " heights are missing", missing});
  return present;
}

struct Side {
  std::size_t count;
  double spacing_m;
  double origin_m;
};

// A grid of about `spacing_m` over [low, high], or over one period.
Side side(double low, double high, double spacing_m, double period_m, Border border) {
  if (border == Border::kPeriodic) {
    const double length = period_m > 0.0 ? period_m : high - low;
    const double cells = std::max(4.0, std::round(length / spacing_m));
    if (!(cells <= static_cast<double>(kMostASide)))
      throw Error("texture: a grid of " + number_text(cells) + " points a side; at most " + std::to_string(kMostASide));
    return {static_cast<std::size_t>(cells), length / cells, low};
  }
  // One spline more on either side, and one cell in which the border is rounded.
  const double cells = std::max(1.0, std::ceil((high - low) / spacing_m)) + 4.0;
  if (!(cells < static_cast<double>(kMostASide)))
    throw Error("texture: a grid of " + number_text(cells) + " points a side; at most " + std::to_string(kMostASide));
  const double slack = 0.5 * ((cells - 4.0) * spacing_m - (high - low));
  return {static_cast<std::size_t>(cells) + 1, spacing_m, low - slack - 2.0 * spacing_m};
}

// How far apart the values of one coordinate are, if they are those of a grid's lines: evenly spaced, each the same
// number to a thousandth of the spacing. 0 otherwise.
double line_spacing_m(std::vector<double> values_m, std::size_t& lines) {
  std::sort(values_m.begin(), values_m.end());
  const double span_m = values_m.back() - values_m.front();
  std::vector<double> line_m{values_m.front()};
  for (const double x : values_m)
    if (x - line_m.back() > 1e-7 * span_m) line_m.push_back(x);
  lines = line_m.size();
  const double spacing_m = span_m / static_cast<double>(lines - 1);
  for (std::size_t i = 0; i < lines; ++i)
    if (std::abs(line_m[i] - line_m.front() - static_cast<double>(i) * spacing_m) > 1e-3 * spacing_m) return 0.0;
  return spacing_m;
}

// That of the data (see fit_areal.h), missing heights counted: a map with gaps is a map.
double default_spacing_m(std::span<const ArealSample> samples, const Extent& e, Problems& problems) {
  constexpr double kScattered_m = 1e-4;
  constexpr double kMostPoints = 1048576.0, kMostPointsASide = 2048.0;
  std::vector<double> x_m, y_m;
  for (const ArealSample& s : samples) {
    x_m.push_back(s.x_m);
    y_m.push_back(s.y_m);
  }
  std::size_t columns = 0, rows = 0;
  const double across_m = line_spacing_m(std::move(x_m), columns), along_m = line_spacing_m(std::move(y_m), rows);
  const double width_m = e.high_x - e.low_x, height_m = e.high_y - e.low_y;
  // Strokes far apart are no map, however even.
  const bool is_grid = across_m > 0.0 && along_m > 0.0 && columns * rows == samples.size() &&
                       std::max(across_m, along_m) <= 3.0 * std::min(across_m, along_m);
  const double wanted_m =
      is_grid ? std::min(across_m, along_m)
              : std::min(kScattered_m, std::sqrt(width_m * height_m / static_cast<double>(samples.size())));
  const double possible_m =
      std::max(std::sqrt(width_m * height_m / kMostPoints), std::max(width_m, height_m) / kMostPointsASide);
  if (wanted_m >= possible_m) return wanted_m;
  problems.push_back({"coarser_than_data",
                      "the surface's points are " + rounded_text(1e3 * possible_m) + " mm apart, the data's " +
                          rounded_text(1e3 * wanted_m) + " mm (areal.spacing_mm)",
                      1});
  return possible_m;
}

SplineGrid empty_grid(const Extent& e, const FitArealConfig& config, double spacing_m) {
  const Side x = side(e.low_x, e.high_x, spacing_m, config.period_x_mm * 1e-3, config.border);
  const Side y = side(e.low_y, e.high_y, spacing_m, config.period_y_mm * 1e-3, config.border);
  if (x.count * y.count > kMostNodes)
    throw Error("texture: a grid of " + std::to_string(x.count) + " x " + std::to_string(y.count) +
                " points; at most " + std::to_string(kMostNodes) + " are possible");
  SplineGrid grid{x.count, y.count, x.spacing_m, y.spacing_m, x.origin_m, y.origin_m, config.border, {}};
  grid.coefficient_m.assign(x.count * y.count, 0.0);
  return grid;
}

}  // namespace

ArealFit fit_areal(std::span<const ArealSample> samples, const FitArealConfig& config, const Observer& observer) {
  if (!(config.spacing_mm >= 0.0) || !std::isfinite(config.spacing_mm))
    throw Error("texture: the spacing " + number_text(config.spacing_mm) + " mm is negative");
  ArealFit fit;
  const std::vector<ArealSample> present = checked(samples, fit.problems);
  const Extent extent = extent_of(present);
  if (!(extent.high_x > extent.low_x) || !(extent.high_y > extent.low_y))
    throw Error("texture: the heights are on one line; a surface needs an area");
  constexpr double kSmallest_m = 1e-9;
  if (const double side_m = std::max(extent.high_x - extent.low_x, extent.high_y - extent.low_y); side_m < kSmallest_m)
    throw Error("texture: heights over " + number_text(side_m) + " m are not plausible: at least " +
                number_text(kSmallest_m) + " m");
  double mean_m = 0.0;
  for (const auto& s : present) mean_m += s.height_m / static_cast<double>(present.size());

  const double spacing_m =
      config.spacing_mm > 0.0 ? config.spacing_mm * 1e-3 : default_spacing_m(samples, extent, fit.problems);
  const double longest = std::max(extent.high_x - extent.low_x, extent.high_y - extent.low_y);
  int levels = 1;
  while (levels < 12 && longest / (spacing_m * std::pow(2.0, levels)) > 16.0) ++levels;
  SplineGrid grid;
  for (int level = levels - 1; level >= 0; --level) {
    SplineGrid finer = empty_grid(extent, config, spacing_m * std::pow(2.0, level));
    if (!grid.coefficient_m.empty()) resample_grid(grid, finer);
    grid = std::move(finer);
    const ArealSystem system(grid, present, mean_m, config.smoothness);
    fit.relative_residual =
        system.solve(grid.coefficient_m, config.iterations, level == 0 ? kSolveTolerance : 1e-4, observer);
    if (level == 0) fit.texture.supported = system.supported();
  }
  for (double& c : grid.coefficient_m) c += mean_m;
  fit.texture.surface = std::move(grid);

  double square = 0.0;
  double error = 0.0;
  for (const auto& s : present) {
    square += std::pow(s.height_m - mean_m, 2);
    error += std::pow(s.height_m - evaluate_height(fit.texture.surface, s.x_m, s.y_m).height_m, 2);
  }
  fit.rms_height_m = std::sqrt(square / static_cast<double>(present.size()));
  fit.rms_error_m = std::sqrt(error / static_cast<double>(present.size()));
  const auto& supported = fit.texture.supported;
  const auto gaps = static_cast<std::size_t>(std::count(supported.begin(), supported.end(), std::uint8_t{0}));
  fit.supported_part = 1.0 - static_cast<double>(gaps) / static_cast<double>(supported.size());
  if (gaps > 0) {
    fit.problems.push_back({"areal_gaps",
                            std::to_string(gaps) + " of " + std::to_string(supported.size()) +
                                " grid points have no height near and are filled smoothly",
                            gaps});
  }
  if (fit.relative_residual > 1e-4) {
    fit.problems.push_back({"not_converged",
                            "the surface's equations are solved to a relative residual of " +
                                rounded_text(fit.relative_residual) + " only; more iterations, or a coarser grid",
                            1});
  }
  fit.height_offset_m = -lowest_height_m(fit.texture.surface);
  return fit;
}

}  // namespace asperity
