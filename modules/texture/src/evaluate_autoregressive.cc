#include "asperity/texture/evaluate_autoregressive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asperity/texture/autoregressive_filter.h"
#include "series_steps.h"

namespace asperity {
namespace {

constexpr int kMaxSamplesPerStep = 16;
// Rounding may bring a reflection coefficient of two nearly equal frequencies to 1: its section is still a rotation.
constexpr double kMaxReflection = 1.0 - 0x1p-40;

struct Point {
  double u = 0.0;
  double v = 0.0;
};

Point point_at(const AutoregressiveTexture& t, int i) noexcept {
  const auto& m = t.models[static_cast<std::size_t>(i)];
  return {m.speed_mps / t.max_speed_mps, m.force_N / t.max_force_N};
}

double cross(const Point& a, const Point& b, const Point& c) noexcept {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

bool inside(const AutoregressiveTexture& t, int triangle, const Point& p, SeriesBlend& blend) noexcept {
  const auto& tri = t.triangles[static_cast<std::size_t>(triangle)];
  const Point a = point_at(t, tri[0]);
  const Point b = point_at(t, tri[1]);
  const Point c = point_at(t, tri[2]);
  const double wa = cross(b, c, p);
  const double wb = cross(c, a, p);
  const double wc = cross(a, b, p);
  if (!(wa >= 0.0 && wb >= 0.0 && wc >= 0.0)) return false;
  const double sum = wa + wb + wc;
  if (!(sum > 0.0)) return false;
  blend = {tri, {wa / sum, wb / sum, wc / sum}, triangle};
  return true;
}

SeriesBlend nearest_on_border(const AutoregressiveTexture& t, const Point& p) noexcept {
  SeriesBlend best{{0, 0, 0}, {1.0, 0.0, 0.0}, -1};
  double nearest = -1.0;
  for (const auto& edge : t.edges) {
    const Point a = point_at(t, edge[0]);
    const Point b = point_at(t, edge[1]);
    const double du = b.u - a.u;
    const double dv = b.v - a.v;
    const double length2 = du * du + dv * dv;
    const double along = length2 > 0.0 ? std::clamp(((p.u - a.u) * du + (p.v - a.v) * dv) / length2, 0.0, 1.0) : 0.0;
    const double eu = a.u + along * du - p.u;
    const double ev = a.v + along * dv - p.v;
    const double distance2 = eu * eu + ev * ev;
    if (nearest < 0.0 || distance2 < nearest) {
      nearest = distance2;
      best = {{edge[0], edge[1], edge[0]}, {1.0 - along, along, 0.0}, -1};
    }
  }
  return best;
}

// One sample of white noise through the lattice: unit variance in, unit variance out.
double lattice_step(const BlendedFilter& filter, const double* c, SeriesState& state) noexcept {
  double f = fixed_time_normal(state.random);
  for (int m = filter.order; m-- > 0;) {
    const auto i = static_cast<std::size_t>(m);
    const double k = filter.k[i];
    const double b = state.backward[i];
    state.backward[i + 1] = k * f + c[i] * b;
    f = c[i] * f - k * b;
  }
  state.backward[0] = f;
  return f;
}

double next_sample(const BlendedFilter& filter, const double* c, SeriesState& state) noexcept {
  const double y = lattice_step(filter, c, state);
  if (filter.ma_order == 0) return y;
  auto& past = state.pole_output;
  double sum = y;
  for (int i = filter.ma_order; i-- > 0;) {
    const auto j = static_cast<std::size_t>(i);
    sum += filter.b[j] * past[j];
    past[j + 1] = past[j];
  }
  past[0] = y;
  return sum / filter.numerator_sigma;
}

// What linear interpolation between two neighbours, each of unit variance, leaves of it: 1 − 2φ(1 − φ)(1 − ρ). The
// least is that of an alternating series half way, of which nothing is left to amplify.
double interpolated_variance(double phase, double neighbour_correlation) noexcept {
  constexpr double kLeast = 0x1p-10;
  return std::max(kLeast, 1.0 - 2.0 * phase * (1.0 - phase) * (1.0 - neighbour_correlation));
}

// The standard deviation of Σ b_i y_{n−i}, b_0 = 1, and the correlation of two neighbours of it, y being the output of
// unit variance of 1/A.
void measure_numerator(BlendedFilter& filter) noexcept {
  constexpr double kLeastVariance = 0x1p-40;  // below it rounding decides
  const auto ma_order = static_cast<std::size_t>(filter.ma_order);
  std::array<double, kMaxSeriesOrder + 2> r{};
  autocorrelation(std::span<const double>(filter.k).first(static_cast<std::size_t>(filter.order)),
                  std::span(r).first(ma_order + 2));
  const auto b = [&](std::size_t i) { return i == 0 ? 1.0 : filter.b[i - 1]; };
  double variance = 0.0;
  double neighbours = 0.0;
  for (std::size_t i = 0; i <= ma_order; ++i) {
    for (std::size_t j = 0; j <= ma_order; ++j) {
      const double product = b(i) * b(j);
      variance += product * r[i > j ? i - j : j - i];
      neighbours += product * r[i + 1 > j ? i + 1 - j : j - i - 1];
    }
  }
  variance = std::max(variance, kLeastVariance);
  filter.numerator_sigma = std::sqrt(variance);
  filter.neighbour_correlation = std::clamp(neighbours / variance, -1.0, 1.0);
}

struct Step {
  double acceleration_mps2 = 0.0;
  double sigma_mps2 = 0.0;
};

Step next_step(const AutoregressiveTexture& t, SeriesState& state, double speed_mps, double force_N,
               double dt_s) noexcept {
  speed_mps = servo_input(speed_mps);
  force_N = servo_input(force_N);
  const SeriesBlend blend = blend_models(t, speed_mps, force_N, state.triangle);
  if (blend.triangle >= 0) state.triangle = blend.triangle;
  const BlendedFilter filter = blended_filter(t, blend);

  state.phase += servo_input(dt_s) * t.rate_Hz;
  const double whole = std::floor(state.phase);
  state.phase -= whole;
  if (!(state.phase >= 0.0 && state.phase < 1.0)) state.phase = 0.0;
  const int samples = static_cast<int>(std::min(whole, static_cast<double>(kMaxSamplesPerStep)));
  if (samples > 0) {
    std::array<double, kMaxSeriesOrder> c;
    for (std::size_t i = 0; i < static_cast<std::size_t>(filter.order); ++i)
      c[i] = std::sqrt(1.0 - filter.k[i] * filter.k[i]);
    for (int i = 0; i < samples; ++i) {
      state.previous = state.current;
      state.current = next_sample(filter, c.data(), state);
    }
  }
  const double y = (state.previous + state.phase * (state.current - state.previous)) /
                   std::sqrt(interpolated_variance(state.phase, filter.neighbour_correlation));
  const double sigma_mps2 =
      fade_factor(speed_mps, t.fade_speed_mps) * fade_factor(force_N, t.fade_force_N) * filter.sigma_mps2;
  return {sigma_mps2 * y, sigma_mps2};
}

}  // namespace

SeriesBlend blend_models(const AutoregressiveTexture& texture, double speed_mps, double force_N, int hint) noexcept {
  const Point p{servo_input(speed_mps) / texture.max_speed_mps, servo_input(force_N) / texture.max_force_N};
  SeriesBlend blend;
  const int count = static_cast<int>(texture.triangles.size());
  if (hint >= 0 && hint < count && inside(texture, hint, p, blend)) return blend;
  for (int i = 0; i < count; ++i) {
    if (inside(texture, i, p, blend)) return blend;
  }
  return nearest_on_border(texture, p);
}

BlendedFilter blended_filter(const AutoregressiveTexture& texture, const SeriesBlend& blend) noexcept {
  BlendedFilter filter;
  const auto& first = texture.models[static_cast<std::size_t>(blend.model[0])];
  filter.order = static_cast<int>(first.ar_lsf_rad.size());
  filter.ma_order = static_cast<int>(first.ma_lsf_rad.size());
  const auto order = static_cast<std::size_t>(filter.order);
  const auto ma_order = static_cast<std::size_t>(filter.ma_order);
  std::array<double, kMaxSeriesOrder> lsf{};
  std::array<double, kMaxSeriesOrder> ma_lsf{};
  double output_variance = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto& model = texture.models[static_cast<std::size_t>(blend.model[j])];
    const double w = blend.weight[j];
    for (std::size_t i = 0; i < order; ++i) lsf[i] += w * model.ar_lsf_rad[i];
    for (std::size_t i = 0; i < ma_order; ++i) ma_lsf[i] += w * model.ma_lsf_rad[i];
    output_variance += w * model.sigma_mps2 * model.sigma_mps2;
  }
  std::array<double, kMaxSeriesOrder> a{};
  lsf_to_ar(std::span(lsf).first(order), std::span(a).first(order));
  ar_to_reflection(std::span(a).first(order), std::span(filter.k).first(order));
  for (std::size_t i = 0; i < order; ++i) filter.k[i] = std::clamp(filter.k[i], -kMaxReflection, kMaxReflection);
  filter.sigma_mps2 = std::sqrt(output_variance);
  filter.neighbour_correlation = -filter.k[0];
  if (ma_order > 0) {
    lsf_to_ar(std::span(ma_lsf).first(ma_order), std::span(filter.b).first(ma_order));
    measure_numerator(filter);
  }
  return filter;
}

double next_acceleration_mps2(const AutoregressiveTexture& texture, SeriesState& state, double speed_mps,
                              double force_N, double dt_s) noexcept {
  return next_step(texture, state, speed_mps, force_N, dt_s).acceleration_mps2;
}

SeriesForce next_force(const AutoregressiveTexture& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept {
  const Step step = next_step(texture, state, speed_mps, force_N, dt_s);
  const double force = texture.mass_kg * step.acceleration_mps2;
  return {with_offset(force, texture.mass_kg * step.sigma_mps2, texture.offset_sigmas),
          texture.tangential_ratio * force};
}

}  // namespace asperity
