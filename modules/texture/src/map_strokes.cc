#include "asperity/texture/map_strokes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/rounded_text.h"
#include "stroke_field.h"
#include "stroke_samples.h"

namespace asperity {
namespace {

constexpr int kRounds = 3;  // of map and predictions
constexpr int kShiftSteps = 4;
constexpr double kTieCorrelation = 0.6;  // nearer than this strokes see much the same
constexpr double kLeastAgreement = 0.1;
constexpr double kPowerPart = 0.98;     // of a stroke's, up to where its waves are resolved
constexpr double kMarginLengths = 1.0;  // correlation lengths of grid beyond the samples

struct Model {
  std::vector<StrokeSample> samples;
  DriftBasis basis;
  FieldPrior prior;
  MapGrid grid;
  double step_mm = 0.0;
  double disagreement_m2 = 0.0;
  double noise_m2 = 0.0;  // as the scans state it

  // A stroke's error has waves as the surface has; white noise of the same density does the same to them.
  double sample_noise_m2() const { return disagreement_m2 * std::max(1.0, prior.spectrum.independent_mm() / step_mm); }
};

// Errors of one stroke against the map of all others, its own drift and shift taken off as far as their priors let.
struct Prediction {
  double samples = 0.0;
  double independent = 0.0;  // heights among them
  double error_m2 = 0.0;     // sums
  double map_m2 = 0.0;
  double height_m2 = 0.0;
  double ratio2 = 0.0;
  std::vector<double> own_m2;  // of each stroke, what the map's σ does not explain
};

Prediction predict_stroke(const Model& model, const StrokeField& all, std::uint32_t stroke, double claim_m) {
  std::vector<StrokeSample> own, others;
  for (const StrokeSample& s : model.samples)
    if (s.stroke == stroke) own.push_back(s);
  Prediction out;
  if (own.size() < 16) return out;
  // Strokes further than this have nothing to say.
  const double margin_mm =
      std::max(4.0 * model.prior.spectrum.distance_mm(std::exp(-1.0)), 6.0 * model.grid.spacing_mm);
  const MapGrid grid = make_map_grid(own, model.grid.spacing_mm, margin_mm + 5.0 * model.prior.shift_mm);
  const double high_x = grid.x_mm + (grid.columns - 3) * grid.spacing_mm - 4.0 * model.prior.shift_mm;
  const double high_y = grid.y_mm + (grid.rows - 3) * grid.spacing_mm - 4.0 * model.prior.shift_mm;
  const double low_x = grid.x_mm + 2 * grid.spacing_mm + 4.0 * model.prior.shift_mm;
  const double low_y = grid.y_mm + 2 * grid.spacing_mm + 4.0 * model.prior.shift_mm;
  for (const StrokeSample& s : model.samples)
    if (s.stroke != stroke && s.x_mm > low_x && s.x_mm < high_x && s.y_mm > low_y && s.y_mm < high_y)
      others.push_back(s);
  if (others.empty()) return out;
  FieldPrior prior = model.prior;
  prior.noise_m2 = model.sample_noise_m2();
  std::vector<Eigen::Vector2d> start = all.shift_mm;
  prior.shift_mm = 0.0;  // as all strokes together show them
  const StrokeField field = solve_field(grid, others, model.basis, prior, start, 1, true);

  // Own drift and shift, by least squares with their priors.
  const auto hats = static_cast<Eigen::Index>(model.basis.first[stroke + 1] - model.basis.first[stroke]);
  const Eigen::Index unknowns = hats + 3;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  struct Line {
    Eigen::VectorXd row;
    double value = 0.0, sigma_m = 0.0, texture_m = 0.0;
  };
  std::vector<Line> lines;
  for (const StrokeSample& s : own) {
    Line line;
    line.sigma_m = field.sigma_at(s.x_mm, s.y_mm);
    if (line.sigma_m > claim_m) continue;
    const Eigen::Vector3d h = field.at(s.x_mm, s.y_mm);
    line.row = Eigen::VectorXd::Zero(unknowns);
    const Eigen::Index i = std::min(static_cast<Eigen::Index>(s.s_mm / model.basis.knot_mm), hats - 2);
    const double share = s.s_mm / model.basis.knot_mm - static_cast<double>(i);
    line.row[i] = 1.0 - share;
    line.row[i + 1] = share;
    line.row[hats] = 1.0;
    line.row[hats + 1] = h[1];
    line.row[hats + 2] = h[2];
    line.value = s.height_m - h[0];
    line.texture_m = s.texture_m;
    const double variance = line.sigma_m * line.sigma_m + prior.noise_m2;
    normal += line.row * line.row.transpose() / variance;
    right += line.row * line.value / variance;
    lines.push_back(std::move(line));
  }
  if (lines.size() < 16) return out;
  const Eigen::MatrixXd of_samples = normal;
  for (Eigen::Index i = 0; i < hats; ++i) normal(i, i) += 1.0 / (prior.drift_m * prior.drift_m);
  normal(hats, hats) += 1.0 / (prior.offset_m * prior.offset_m);
  const double shift_mm = std::max(model.prior.shift_mm, 1e-6);
  for (const Eigen::Index i : {hats + 1, hats + 2}) normal(i, i) += 1.0 / (shift_mm * shift_mm);
  const Eigen::VectorXd x = solve_symmetric(normal, right);
  for (const Line& line : lines) {
    const double error2 = std::pow(line.value - line.row.dot(x), 2);
    out.error_m2 += error2;
    out.map_m2 += line.sigma_m * line.sigma_m;
    out.height_m2 += line.texture_m * line.texture_m;
    out.ratio2 += error2 / (line.sigma_m * line.sigma_m + model.disagreement_m2);
  }
  out.samples = static_cast<double>(lines.size());
  // What the fit has taken of the errors: as many independent ones as it has unknowns that the samples determine.
  const double fitted = (solve_symmetric(normal, of_samples)).trace();
  out.independent = out.samples * std::min(1.0, model.step_mm / model.prior.spectrum.independent_mm());
  const double share = std::clamp(1.0 - fitted / out.independent, 0.2, 1.0);
  out.error_m2 /= share;
  out.ratio2 /= share;
  return out;
}

Prediction predict_strokes(const Model& model, const StrokeField& field, std::size_t strokes,
                           const MapStrokesConfig& config, std::size_t& count, const Observer& observer) {
  Prediction sum;
  const double claim_m = config.hole_share * std::sqrt(model.prior.spectrum.variance_m2());
  const std::size_t tries = std::min<std::size_t>(strokes, static_cast<std::size_t>(std::max(config.held_out, 0)));
  count = 0;
  for (std::size_t i = 0; i < tries; ++i) {
    observer.update("held-out strokes", static_cast<double>(i) / static_cast<double>(tries));
    const auto stroke = static_cast<std::uint32_t>((2 * i + 1) * strokes / (2 * tries));
    const Prediction one = predict_stroke(model, field, stroke, claim_m);
    if (one.samples == 0.0) continue;
    ++count;
    sum.samples += one.samples;
    sum.independent += one.independent;
    sum.error_m2 += one.error_m2;
    sum.map_m2 += one.map_m2;
    sum.height_m2 += one.height_m2;
    sum.ratio2 += one.ratio2;
    sum.own_m2.push_back((one.error_m2 - one.map_m2) / one.samples);
  }
  return sum;
}

void add_texture(const Model& model, const StrokeField& field, double hole_share, StrokeMap& out) {
  const MapGrid& grid = field.grid;
  SplineGrid& surface = out.texture.surface;
  surface.columns = static_cast<std::size_t>(grid.columns);
  surface.rows = static_cast<std::size_t>(grid.rows);
  surface.spacing_x_m = surface.spacing_y_m = 1e-3 * grid.spacing_mm;
  surface.origin_x_m = 1e-3 * grid.x_mm;
  surface.origin_y_m = 1e-3 * grid.y_mm;
  surface.border = Border::kClamp;
  surface.coefficient_m.assign(field.coefficient_m.data(), field.coefficient_m.data() + field.coefficient_m.size());
  out.texture.sigma_m = field.sigma_m;
  double square = 0.0, count = 0.0;
  for (const double sigma_m : field.sigma_m) {
    const bool claimed = sigma_m <= hole_share * out.rms_m;
    out.texture.supported.push_back(claimed ? 1 : 0);
    square += claimed ? sigma_m * sigma_m : 0.0;
    count += claimed ? 1.0 : 0.0;
  }
  out.sigma_rms_m = count > 0.0 ? std::sqrt(square / count) : 0.0;
  for (std::size_t k = 0; k + 1 < model.basis.first.size(); ++k) {
    const auto begin = static_cast<Eigen::Index>(model.basis.first[k]);
    const auto hats = field.hat_m.segment(begin, static_cast<Eigen::Index>(model.basis.first[k + 1]) - begin);
    out.drift_rms_m.push_back(std::sqrt((hats.array() - hats.mean()).square().mean()));
    out.shift_x_m.push_back(1e-3 * field.shift_mm[k].x());
    out.shift_y_m.push_back(1e-3 * field.shift_mm[k].y());
  }
}

}  // namespace

StrokeMap map_strokes(std::span<const AreaStroke> strokes, const MapStrokesConfig& config, const Observer& observer) {
  std::vector<AreaStroke> given(strokes.begin(), strokes.end());
  Model model;
  double noise_count = 0.0, mean_m = 0.0, heights = 0.0;
  for (const AreaStroke& stroke : given) {
    if (!(stroke.spacing_m > 0.0) || stroke.x_m.size() != stroke.height_m.size() ||
        stroke.y_m.size() != stroke.height_m.size())
      throw Error("texture: a stroke's positions and heights are not one a sample");
    if (stroke.noise_m > 0.0) {
      model.noise_m2 += stroke.noise_m * stroke.noise_m;
      noise_count += 1.0;
    }
    for (const double z : stroke.height_m) {
      if (!std::isfinite(z)) continue;
      mean_m += z;
      heights += 1.0;
    }
  }
  if (heights < 16.0) throw Error("texture: no stroke has heights");
  if (noise_count > 0.0) model.noise_m2 /= noise_count;
  for (AreaStroke& stroke : given)
    for (double& z : stroke.height_m) z -= mean_m / heights;

  StrokeMap out;
  const StrokeSpectrum measured = measure_strokes(given, config.drift_mm, kPowerPart);
  if (measured.density_m2mm.size() < 4) return out;
  model.prior.spectrum = fit_areal_spectrum(measured.frequency_cycles_per_mm, measured.density_m2mm);
  const double shortest_mm = 1.0 / measured.frequency_cycles_per_mm.back();
  double spacing_mm = config.spacing_mm > 0.0 ? config.spacing_mm : shortest_mm / 3.0;
  model.basis = make_drift_basis(given, config.drift_mm);
  // A grid as fine as is possible.
  for (int attempt = 0; attempt < 40; ++attempt) {
    model.step_mm = 0.5 * spacing_mm;
    model.samples = thin_strokes(given, model.step_mm);
    if (model.samples.size() < 16) return out;
    const double margin_mm =
        kMarginLengths * model.prior.spectrum.distance_mm(std::exp(-1.0)) + 4.0 * config.shift_mm + spacing_mm;
    model.grid = make_map_grid(model.samples, spacing_mm, margin_mm);
    if (model.grid.size() <= config.most_points) break;
    const double wanted_mm = spacing_mm;
    spacing_mm *= 1.05 * std::sqrt(static_cast<double>(model.grid.size()) / config.most_points);
    if (out.problems.empty()) {
      out.problems.push_back({"coarser_than_data",
                              "the map's points are further apart than the " + rounded_text(wanted_mm) +
                                  " mm that the strokes' waves need (map.most_points)",
                              1});
    }
  }
  model.prior.drift_m = detrend(model.samples, model.basis);
  out.correlation_mm = model.prior.spectrum.distance_mm(std::exp(-1.0));
  out.ties = count_ties(model.samples, model.prior.spectrum.distance_mm(kTieCorrelation));
  if (out.ties == 0) return out;
  double own_m2 = 0.0;
  for (const StrokeSample& s : model.samples)
    own_m2 += s.texture_m * s.texture_m / static_cast<double>(model.samples.size());
  const double whole_A = model.prior.spectrum.A;
  model.prior.drift_m = std::max(model.prior.drift_m, 0.05 * std::sqrt(own_m2));
  model.prior.offset_m = 10.0 * (std::sqrt(own_m2) + model.prior.drift_m);
  model.prior.shift_mm = config.shift_mm;
  // At first strokes are taken to agree, so that the map claims enough to be proved wrong.
  model.disagreement_m2 = std::max(model.noise_m2, 0.05 * own_m2);

  StrokeField field;
  field.shift_mm.assign(given.size(), Eigen::Vector2d::Zero());
  for (int round = 0; round < kRounds; ++round) {
    observer.update("map", static_cast<double>(round) / kRounds);
    FieldPrior prior = model.prior;
    prior.noise_m2 = model.sample_noise_m2();
    const bool last = round + 1 == kRounds;
    field = solve_field(model.grid, model.samples, model.basis, prior, field.shift_mm,
                        config.shift_mm > 0.0 ? kShiftSteps : 1, last);
    std::size_t count = 0;
    const Prediction sum = predict_strokes(model, field, given.size(), config, count, observer);
    out.held_out.strokes = count;
    out.held_out.samples = sum.samples;
    if (count < 2) return out;
    out.held_out.error_rms_m = std::sqrt(sum.error_m2 / sum.samples);
    out.held_out.error_over_sigma = std::sqrt(sum.ratio2 / sum.samples);
    out.held_out.explained = 1.0 - sum.error_m2 / sum.height_m2;
    const double seen_m2 = (sum.error_m2 - sum.map_m2) / sum.samples;
    double scatter = 0.0;
    for (const double one_m2 : sum.own_m2) scatter += std::pow(one_m2 - seen_m2, 2);
    const auto strokes_held = static_cast<double>(count);
    out.agreement = 1.0 - seen_m2 / own_m2;
    // By the scatter of the strokes, which says little of two that were predicted from one another, and at least by the
    // number of heights: a mean square of n has the relative error √(2/n).
    const double by_scatter = std::sqrt(scatter / (strokes_held - 1.0) / strokes_held) / own_m2;
    const double by_heights = std::sqrt(2.0 / sum.independent) * sum.error_m2 / sum.samples / own_m2;
    out.agreement_sigma = std::max(by_scatter, by_heights);
    out.disagreement_m = std::sqrt(std::max(seen_m2, 0.0));
    // Strokes that do not predict each other have no surface in common.
    if (!(out.agreement > std::max(2.0 * out.agreement_sigma, kLeastAgreement))) return out;
    if (last) break;
    model.disagreement_m2 = std::clamp(seen_m2, std::max(model.noise_m2, 0.01 * own_m2), own_m2);
    model.prior.spectrum.A = whole_A * std::clamp(1.0 - model.disagreement_m2 / own_m2, kLeastAgreement, 1.0);
  }
  out.spectrum = model.prior.spectrum;
  out.rms_m = std::sqrt(model.prior.spectrum.variance_m2());
  out.disagreement_m = std::sqrt(model.disagreement_m2);
  add_texture(model, field, config.hole_share, out);
  observer.update("map", 1.0);
  return out;
}

}  // namespace asperity
