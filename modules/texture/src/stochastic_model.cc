#include "asperity/texture/stochastic_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_stochastic.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"

namespace asperity {

using StochasticTraits = TextureModelTraits<StochasticTexture>;

namespace {

constexpr double kOffsetSigma = 3.0;
// The rate at which the original drew its heights (Siira and Pai 1996).
constexpr double kOriginalRate_Hz = 1000.0;
// The stiffness is that of the place.
constexpr double kOfThePlace = -1.0;

}  // namespace

Json StochasticTraits::describe(const StochasticTexture& t) {
  return {{"sigma_m", t.sigma_m},
          {"correlation_length_m", t.correlation_length_m},
          {"stiffness_N_per_m", t.stiffness_N_per_m}};
}

void StochasticTraits::scale(StochasticTexture& t, double factor) { t.sigma_m *= factor; }

void StochasticTraits::add_to(TextureHash& hash, const StochasticTexture& t) {
  hash.add(t.sigma_m, t.correlation_length_m, t.tangential_ratio, t.offset_sigmas, t.stiffness_N_per_m,
           t.reference_speed_mps, t.speed_exponent, t.reference_force_N, t.force_exponent, t.fade_speed_mps);
}

void StochasticTraits::low_pass(StochasticTexture& t, double cutoff_cycles_per_mm) {
  t.correlation_length_m = std::max(t.correlation_length_m, 0.5e-3 / cutoff_cycles_per_mm);
}

SeriesContactForce StochasticTraits::contact_force(const StochasticTexture& t, SeriesState& state,
                                                   const SeriesContact& contact) noexcept {
  const StochasticHeight next = next_stochastic_height(t, state, contact.speed_mps, contact.load_N, contact.dt_s);
  const double height_m = contact.fade * next.height_m;
  const double stiffness_N_per_m =
      contact.compliance_kc * (t.stiffness_N_per_m >= 0.0 ? t.stiffness_N_per_m : contact.stiffness_N_per_m);
  const double depth_m = std::clamp(height_m - contact.z_m, 0.0, std::max(height_m, 0.0));
  // How much of the height is pressed in: the tangential part comes and goes with the normal one.
  const double pressed = contact.z_m <= 0.0 ? 1.0 : height_m > 0.0 ? depth_m / height_m : 0.0;
  double normal_N = stiffness_N_per_m * depth_m;
  double tangential_N = pressed * stiffness_N_per_m * contact.fade * (t.tangential_ratio * next.above_mean_m);
  if (!(t.offset_sigmas > 0.0)) {
    // Heights of both signs: a hole takes away load that is there and no more.
    if (height_m < 0.0) normal_N = std::max(stiffness_N_per_m * height_m, -contact.load_N);
    tangential_N = std::clamp(tangential_N, -contact.load_N, contact.load_N);
  }
  return {normal_N, tangential_N, std::max(height_m, 0.0), depth_m};
}

void StochasticTraits::stroke(const StochasticTexture& t, const StrokeConfig& c, std::vector<double>& acceleration_mps2,
                              const Observer& observer) {
  StochasticTexture plain = t;
  plain.offset_sigmas = 0.0;
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  RowWatch watch(observer);
  for (double& a : acceleration_mps2) {
    watch.next();
    a = t.stiffness_N_per_m / t.mass_kg * next_height_m(plain, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  }
}

void StochasticTraits::prepare(StochasticTexture& t, double) {
  if (!(t.correlation_length_m > 0.0)) t.correlation_length_m = t.reference_speed_mps / kOriginalRate_Hz;
}

SeriesHeights StochasticTraits::heights(const StochasticTexture& t) {
  const bool scaled = t.speed_exponent != 0.0 || t.force_exponent != 0.0;
  const double offset_m = std::max(t.offset_sigmas, 0.0) * t.sigma_m;
  return {offset_m, (scaled ? kMostStochasticScale : 1.0) * 2.0 * offset_m, t.stiffness_N_per_m};
}

void StochasticTraits::take_heights(StochasticTexture& t, const Texture& height_field) {
  constexpr std::size_t kSamples = 2048;
  constexpr int kLines = 16;
  const TextureModel& model = height_field.model;
  const HeightWindow window = height_window(model, 256).value_or(HeightWindow{});
  const double spacing_m = window.length_m / static_cast<double>(kSamples);
  const int lines = line_length_mm(model) ? 1 : kLines;
  std::vector<double> height_m;
  for (int line = 0; line < lines; ++line) {
    const double y_m = window.y_m + window.width_m * line / kLines;
    for (const double h : sample_heights(model, {.length_mm = 1e3 * window.length_m,
                                                .spacing_mm = 1e3 * spacing_m,
                                                .x_mm = 1e3 * window.x_m,
                                                .y_mm = 1e3 * y_m}))
      height_m.push_back(h);
    height_m.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  t = StochasticTexture{};
  t.correlation_length_m = spacing_m;
  const bool flat =
      std::all_of(height_m.begin(), height_m.end(), [&](double h) { return std::isnan(h) || h == height_m.front(); });
  if (!flat) t = fit_stochastic(height_m, spacing_m, {.offset_sigmas = kOffsetSigma}).texture;
  // A height stays under a tip at rest.
  t.fade_speed_mps = 0.0;
  t.stiffness_N_per_m = kOfThePlace;
}

void StochasticTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  const HeightLine profile = input.read_heights(input.files);
  out.texture.roughness = input.roughness({profile.height_m}, profile.spacing_m);
  const StochasticFit fit =
      fit_stochastic(profile.height_m, profile.spacing_m, options.of<StochasticTexture>().stochastic);
  out.report["samples"] = fit.samples;
  out.report["sigma_m"] = fit.texture.sigma_m;
  out.report["skewness"] = fit.skewness;
  out.report["excess_kurtosis"] = fit.excess_kurtosis;
  out.report["kolmogorov_distance"] = fit.kolmogorov_distance;
  out.report["correlation_length_m"] = fit.correlation_length_m;
  out.report["not_white"] = fit.not_white;
  out.report["misplaced_power"] = fit.misplaced_power;
  out.add_problems(fit.problems);
  out.texture.model = fit.texture;
}

}  // namespace asperity
