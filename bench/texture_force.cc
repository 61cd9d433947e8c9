// The servo's textures: time of a height with its gradient, each position waiting for the height before; time of a
// step of each force model; the tables' sizes and their errors against the series in long double.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/render/render_texture.h"
#include "asperity/render/texture_force.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/synthesize_isotropic.h"

namespace {

using namespace asperity;
using Clock = std::chrono::steady_clock;

constexpr int kSteps = 1 << 12;
constexpr double kPatience_s = 0.25;

// The fastest of many short runs, in ns a step: what is slower was the machine's.
template <class Step>
double ns_a_step(const Step& step) {
  double best = 1e300;
  const auto begin = Clock::now();
  do {
    const auto start = Clock::now();
    step();
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count() / kSteps);
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < kPatience_s);
  return best;
}

volatile double sink;

// x walks 0.1 mm a step (100 mm/s at 1 kHz) over some periods, and takes a nothing of the result along.
template <class Height>
double latency_ns(const Height& height) {
  return ns_a_step([&] {
    double x_m = 0.0;
    double y_m = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const HeightAndGradient h = height(x_m, y_m);
      const double nothing = 1e-30 * (h.height_m + (h.slope_x + h.slope_y));
      x_m += 1.0137e-4 + nothing;
      y_m += 0.37e-4 + nothing;
      if (x_m > 0.05) x_m -= 0.05;
      if (y_m > 0.05) y_m -= 0.05;
    }
    sink = x_m;
  });
}

Texture of(TextureModel model, const char* name) {
  Texture t;
  t.name = name;
  t.model = std::move(model);
  return t;
}

Fourier1d rough(std::size_t harmonics, double exponent, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{10.0, {}, {}, 0.0};
  for (std::size_t j = 1; j <= harmonics; ++j) {
    const double amplitude = 1e-5 * std::pow(static_cast<double>(j), exponent);
    f.a_m.push_back(amplitude * random.normal());
    f.b_m.push_back(amplitude * random.normal());
  }
  return f;
}

struct Exact {
  long double height = 0.0L;
  long double slope = 0.0L;
};

Exact exact(const Fourier1d& f, double x_m) {
  const long double theta = 2.0L * std::numbers::pi_v<long double> * x_m * 1e3L / f.length_mm;
  Exact e{f.mean_m, 0.0L};
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const long double angle = theta * static_cast<long double>(j + 1);
    e.height += f.a_m[j] * std::cos(angle) + f.b_m[j] * std::sin(angle);
    e.slope += static_cast<long double>(j + 1) * (f.b_m[j] * std::cos(angle) - f.a_m[j] * std::sin(angle));
  }
  e.slope *= 2.0L * std::numbers::pi_v<long double> * 1e3L / f.length_mm;
  return e;
}

void print_series(const Texture& texture, const Fourier1d& f) {
  const RenderTexture t = make_render_texture(texture, {});
  double height = 0.0, slope = 0.0, rms = 0.0, slope_rms = 0.0;
  Random random(7);
  const int places = f.a_m.size() > 1000 ? 500 : 10000;  // the exact sum is slow
  for (int i = 0; i < places; ++i) {
    const double x_m = random.uniform(-0.02, 0.02);
    const Exact e = exact(f, x_m);
    const HeightAndGradient h = render_height(t, x_m, 0.0);
    height = std::max(height, std::abs(static_cast<double>(h.height_m - t.height_offset_m - e.height)));
    slope = std::max(slope, std::abs(static_cast<double>(h.slope_x - e.slope)));
    rms += std::pow(static_cast<double>(e.height), 2) / places;
    slope_rms += std::pow(static_cast<double>(e.slope), 2) / places;
  }
  std::printf("%-28s %7zu kB  height %.1e  slope %.1e of RMS\n", texture.name.c_str(),
              t.tables.x_table.cells.size() * sizeof(TableCell) / 1024, height / std::sqrt(rms),
              slope / std::sqrt(slope_rms));
}

void print_step(const Texture& source, TextureForceModel model) {
  RenderTextureConfig config;
  config.model = model;
  const RenderTexture texture = make_render_texture(source, config);
  const double ns = ns_a_step([&] {
    TextureState state;
    TextureTouch touch;
    touch.x_gradient = Eigen::Vector3d::UnitX();
    touch.y_gradient = Eigen::Vector3d::UnitY();
    touch.z_m = -1e-3;
    touch.contact_N = 1.0;
    touch.stiffness_N_per_m = 1000.0;
    for (int i = 0; i < kSteps; ++i) {
      touch.v_tangential_mps = Eigen::Vector3d(0.1 + 0.08 * (i & 63) / 64.0, 0.0, 0.0);
      touch.x_m += 1.0137e-4;
      const TextureForce force = texture_force(texture, state, touch);
      touch.x_m += 1e-30 * force.force_N.sum();
      if (touch.x_m > 0.05) touch.x_m -= 0.05;
    }
    sink = touch.x_m;
  });
  std::printf("%-28s %7.1f\n", source.name.c_str(), ns);
}

}  // namespace

int main() {
  const Fourier1d white = rough(128, 0.0, 1);
  const Fourier1d pink = rough(128, -1.0, 2);
  Fourier1d single = rough(128, 0.0, 3);
  for (std::size_t j = 0; j < 127; ++j) single.a_m[j] = single.b_m[j] = 0.0;
  const Fourier1d fine = rough(4096, -1.0, 4);
  Fourier2d pattern;
  pattern.kind = Fourier2dKind::kPattern;
  pattern.x = white, pattern.y = pink;
  pattern.x.mean_m = pattern.y.mean_m = 1e-4;
  pattern.scale_per_m = 1e4;
  Fourier2d isotropic;
  isotropic.kind = Fourier2dKind::kIsotropic;
  isotropic.isotropic.power_m2.assign(64, 1e-13);
  isotropic.grid = synthesize_isotropic(isotropic.isotropic);
  HeightMap map{256, 256, 10.0 / 256, 10.0 / 256, 0.0, 2.5e-3, 8, Border::kPeriodic, {}};
  HeightMap large{2048, 2048, 50.0 / 2048, 50.0 / 2048, 0.0, 2.5e-3, 16, Border::kPeriodic, {}};
  Random random(5);
  for (std::size_t i = 0; i < 256 * 256; ++i) map.level.push_back(static_cast<std::uint16_t>(random.bits() & 255));
  for (std::size_t i = 0; i < 2048 * 2048; ++i)
    large.level.push_back(static_cast<std::uint16_t>(random.bits() & 65535));

  std::printf("tables: size and largest error against the series in long double\n");
  print_series(of(white, "128 equal harmonics"), white);
  print_series(of(pink, "128 harmonics, 1/j"), pink);
  print_series(of(single, "the 128th harmonic alone"), single);
  print_series(of(fine, "4096 harmonics, 1/j"), fine);

  std::printf("\nthe chain itself: %.1f ns\n", latency_ns([](double x, double y) {
                return HeightAndGradient{x, y, y};
              }));
  std::printf("latency of height and gradient, ns: rendered, and the texture module's evaluator\n");
  for (const Texture& texture :
       {of(white, "fourier1d, N = 128"), of(fine, "fourier1d, N = 4096"), of(pattern, "fourier2d pattern, 128 x 128"),
        of(isotropic, "fourier2d isotropic, 64"), of(map, "heightmap 256 x 256, 8 bit"),
        of(large, "heightmap 2048 x 2048"), of(ArealTexture{isotropic.grid, {}}, "areal")}) {
    const RenderTexture t = make_render_texture(texture, {});
    const double ours = latency_ns([&](double x, double y) { return render_height(t, x, y); });
    const double theirs = latency_ns([&](double x, double y) { return evaluate_height(texture.model, x, y); });
    std::printf("%-28s %7.1f %9.1f\n", texture.name.c_str(), ours, theirs);
  }

  std::printf("\na step of each model on a stroke, ns\n");
  AutoregressiveTexture vibration;
  for (int i = 0; i < 60; ++i) {
    std::vector<double> k(16);
    for (double& v : k) v = random.uniform(-0.6, 0.6);
    vibration.models.push_back(
        {random.uniform(0.0, 0.2), random.uniform(0.1, 3.0), reflection_to_lsf(k), {}, 1.0, 1.0});
  }
  prepare_autoregressive(vibration, "bench");
  print_step(of(white, "height"), {});
  print_step(of(white, "normal perturbation"), TextureForceModel::kNormalPerturbation);
  print_step(of(white, "lateral gradient"), TextureForceModel::kLateralGradient);
  print_step(of(map, "normal perturbation, image"), TextureForceModel::kNormalPerturbation);
  print_step(of(white, "stochastic"), kForceModelOf<StochasticTexture>);
  print_step(of(vibration, "autoregressive, order 16"), {});
  print_step(of(DecayingSinusoids{.a_per_s = 100.0, .pitch_m = 1e-3}, "decaying sinusoids"), {});
  return 0;
}
