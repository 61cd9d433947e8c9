// Maps of many strokes beside the truth: strokes over a known relief with the errors that scans have (an offset, a
// drift, noise with the texture's waves, a position that is off by a constant and wanders). Prints a table in Markdown;
// docs/areas.md says what it means.
//
//   area_map [--seeds N] [--surfaces rough,steep,pattern,noise] [--layouts cross,lanes,mixed,wide] [--shift-mm 0.1]
//            [--set-shift 0.2] [--each yes]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/signal/statistics.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "asperity/texture/map_strokes.h"
#include "read_options.h"

namespace {

constexpr double kPi = std::numbers::pi;

struct Options {
  int seeds = 5;
  std::vector<std::string> surfaces{"rough", "steep", "pattern", "noise"};
  std::vector<std::string> layouts{"cross", "lanes", "mixed", "wide"};
  double shift_mm = 0.1;
  double prior_shift_mm = 0.2;
  bool each = false;
};

// A relief of many plane waves, mm to m.
struct Relief {
  struct Wave {
    double kx, ky, phase, height_m;
  };
  std::vector<Wave> waves;

  double operator()(double x_mm, double y_mm) const {
    double out = 0.0;
    for (const Wave& w : waves) out += w.height_m * std::cos(w.kx * x_mm + w.ky * y_mm + w.phase);
    return out;
  }
};

// Frequencies from `low` to `high` cycles/mm, each octave's power falling as f^(1 - slope), of `rms_m` in all.
Relief random_relief(double low, double high, double slope, double rms_m, asperity::Random& random) {
  Relief out;
  constexpr int kWaves = 400;
  double square = 0.0;
  for (int i = 0; i < kWaves; ++i) {
    const double f = low * std::pow(high / low, (i + random.uniform(0.0, 1.0)) / kWaves);
    const double angle = random.uniform(0.0, 2.0 * kPi), amplitude = std::pow(f, 0.5 * (1.0 - slope));
    out.waves.push_back(
        {2.0 * kPi * f * std::cos(angle), 2.0 * kPi * f * std::sin(angle), random.uniform(0.0, 2.0 * kPi), amplitude});
    square += 0.5 * amplitude * amplitude;
  }
  for (auto& w : out.waves) w.height_m *= rms_m / std::sqrt(square);
  return out;
}

Relief make_relief(const std::string& name, asperity::Random& random) {
  if (name == "steep") return random_relief(0.15, 2.0, 3.0, 40e-6, random);
  if (name == "pattern") {  // egg crate, pitch 2 mm, turned by 20 degrees
    Relief out;
    const double k = 2.0 * kPi / 2.0, c = std::cos(0.35), s = std::sin(0.35);
    out.waves = {{k * c, k * s, 0.3, 40e-6}, {-k * s, k * c, 1.1, 40e-6}};
    return out;
  }
  return random_relief(0.25, 2.5, 1.0, 40e-6, random);
}

// A slow random course over s, unit RMS: three waves of 15 to 60 mm.
std::function<double(double)> slow_course(asperity::Random& random) {
  std::vector<std::array<double, 2>> waves;
  for (int i = 0; i < 3; ++i) waves.push_back({2.0 * kPi / random.uniform(15.0, 60.0), random.uniform(0.0, 2.0 * kPi)});
  return [waves](double s_mm) {
    double out = 0.0;
    for (const auto& [k, phase] : waves) out += std::sqrt(2.0 / 3.0) * std::cos(k * s_mm + phase);
    return out;
  };
}

struct Line {
  double x0, y0, x1, y1;  // mm
};

std::vector<Line> make_layout(const std::string& name, asperity::Random& random) {
  std::vector<Line> out;
  const auto lanes = [&](int count, double pitch, double length, bool across) {
    for (int i = 0; i < count; ++i) {
      const double at = (i - 0.5 * (count - 1)) * pitch + random.uniform(-0.1, 0.1) * pitch;
      const double lean = random.uniform(-0.15, 0.15) * pitch;
      if (across)
        out.push_back({at - lean, -0.5 * length, at + lean, 0.5 * length});
      else
        out.push_back({-0.5 * length, at - lean, 0.5 * length, at + lean});
    }
  };
  if (name == "cross") {  // 12 and 12, 0.8 mm apart
    lanes(12, 0.8, 16.0, false);
    lanes(12, 0.8, 16.0, true);
  } else if (name == "lanes") {  // 20 beside each other, 0.4 mm apart, and 4 across
    lanes(20, 0.4, 24.0, false);
    lanes(4, 5.0, 12.0, true);
  } else if (name == "mixed") {  // 20 anywhere
    for (int i = 0; i < 20; ++i) {
      const double angle = random.uniform(0.0, kPi), x = random.uniform(-4.0, 4.0), y = random.uniform(-4.0, 4.0);
      out.push_back(
          {x - 9.0 * std::cos(angle), y - 9.0 * std::sin(angle), x + 9.0 * std::cos(angle), y + 9.0 * std::sin(angle)});
    }
  } else {  // wide: 10 and 10, 3 mm apart
    lanes(10, 3.0, 32.0, false);
    lanes(10, 3.0, 32.0, true);
  }
  return out;
}

asperity::AreaStroke stroke_over(const Relief& relief, const Line& line, const Options& options,
                                 asperity::Random& random) {
  asperity::AreaStroke out;
  out.spacing_m = 25e-6;
  const double length_mm = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
  const double ux = (line.x1 - line.x0) / length_mm, uy = (line.y1 - line.y0) / length_mm;
  const auto drift = slow_course(random), wander_x = slow_course(random), wander_y = slow_course(random);
  const double offset_m = 100e-6 * random.normal();
  const double shift_x = options.shift_mm * random.normal(), shift_y = options.shift_mm * random.normal();
  const Relief noise = random_relief(0.2, 3.0, 1.0, 6e-6, random);
  const double wander_mm = 0.3 * options.shift_mm;
  for (double s = 0.0; s <= length_mm; s += 25e-3) {
    const double x = line.x0 + s * ux, y = line.y0 + s * uy;
    out.x_m.push_back(1e-3 * x);
    out.y_m.push_back(1e-3 * y);
    out.height_m.push_back(relief(x + shift_x + wander_mm * wander_x(s), y + shift_y + wander_mm * wander_y(s)) +
                           offset_m + 20e-6 * drift(s) + noise(s, 0.0));
  }
  out.noise_m = 6e-6;
  return out;
}

struct Metrics {
  double rms_um, error_um, sigma_um, ratio, covered, hole_error, agreement, agreement_sigma, held_out, seconds;
  bool mapped;
};

Metrics measure(const std::string& surface, const std::string& layout, int seed, const Options& options) {
  asperity::Random random(static_cast<std::uint64_t>(1000 + seed));
  const std::vector<Line> lines = make_layout(layout, random);
  Relief relief = make_relief(surface, random);
  std::vector<asperity::AreaStroke> strokes;
  for (const Line& line : lines) {
    if (surface == "noise") relief = make_relief("rough", random);  // of its own for each stroke
    strokes.push_back(stroke_over(relief, line, options, random));
  }
  asperity::MapStrokesConfig config;
  config.shift_mm = options.prior_shift_mm;
  const std::clock_t begin = std::clock();
  const asperity::StrokeMap map = asperity::map_strokes(strokes, config);
  Metrics out{};
  out.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  out.agreement = map.agreement;
  out.agreement_sigma = map.agreement_sigma;
  out.held_out = map.held_out.error_over_sigma;
  out.mapped = !map.texture.supported.empty();
  if (!out.mapped) return out;
  const asperity::SplineGrid& g = map.texture.surface;
  std::vector<double> error, sigma, holes;
  double square = 0.0, count = 0.0, ratio = 0.0;
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
  for (const Line& l : lines) {
    low_x = std::min({low_x, l.x0, l.x1});
    high_x = std::max({high_x, l.x0, l.x1});
    low_y = std::min({low_y, l.y0, l.y1});
    high_y = std::max({high_y, l.y0, l.y1});
  }
  double nodes = 0.0;
  for (std::size_t r = 2; r + 2 < g.rows; ++r) {
    for (std::size_t c = 2; c + 2 < g.columns; ++c) {
      const double x_m = g.origin_x_m + static_cast<double>(c) * g.spacing_x_m;
      const double y_m = g.origin_y_m + static_cast<double>(r) * g.spacing_y_m;
      if (1e3 * x_m < low_x || 1e3 * x_m > high_x || 1e3 * y_m < low_y || 1e3 * y_m > high_y) continue;
      nodes += 1.0;
      const double truth_m = relief(1e3 * x_m, 1e3 * y_m);
      square += truth_m * truth_m;
      count += 1.0;
      const double e = asperity::evaluate_height(g, x_m, y_m).height_m - truth_m;
      const std::size_t i = r * g.columns + c;
      if (map.texture.supported[i] == 0) {
        holes.push_back(e);
        continue;
      }
      error.push_back(e);
      sigma.push_back(map.texture.sigma_m[i]);
    }
  }
  double mean = 0.0;
  for (const double e : error) mean += e / static_cast<double>(error.size());
  double error2 = 0.0, sigma2 = 0.0, hole2 = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error2 += std::pow(error[i] - mean, 2);
    sigma2 += sigma[i] * sigma[i];
    ratio += std::pow((error[i] - mean) / sigma[i], 2);
  }
  for (const double e : holes) hole2 += std::pow(e - mean, 2);
  const auto n = static_cast<double>(std::max<std::size_t>(error.size(), 1));
  out.rms_um = 1e6 * std::sqrt(square / count);
  out.error_um = 1e6 * std::sqrt(error2 / n);
  out.sigma_um = 1e6 * std::sqrt(sigma2 / n);
  out.ratio = std::sqrt(ratio / n);
  out.covered = n / nodes;
  out.hole_error = holes.empty() ? 0.0 : 1e6 * std::sqrt(hole2 / static_cast<double>(holes.size())) / out.rms_um;
  return out;
}

void print_row(const std::string& name, const std::vector<Metrics>& all) {
  const auto middle = [&](auto get) {
    std::vector<double> values;
    for (const Metrics& m : all) values.push_back(get(m));
    return asperity::median(values);
  };
  int maps = 0;
  for (const Metrics& m : all) maps += m.mapped ? 1 : 0;
  std::printf("| %s | %d of %zu | %.2f | %.2f | %.1f | %.1f | %.1f | %.2f | %.2f | %.2f | %.2f | %.1f |\n",
              name.c_str(), maps, all.size(), middle([](const Metrics& m) { return m.agreement; }),
              middle([](const Metrics& m) { return m.agreement_sigma; }),
              middle([](const Metrics& m) { return m.rms_um; }), middle([](const Metrics& m) { return m.error_um; }),
              middle([](const Metrics& m) { return m.sigma_um; }), middle([](const Metrics& m) { return m.ratio; }),
              middle([](const Metrics& m) { return m.covered; }), middle([](const Metrics& m) { return m.hole_error; }),
              middle([](const Metrics& m) { return m.held_out; }), middle([](const Metrics& m) { return m.seconds; }));
  std::fflush(stdout);
}

void run(const Options& options) {
  std::printf(
      "| surface | strokes | maps | shared | its σ | surface RMS, µm | error RMS, µm | its σ, µm | error over σ | "
      "covered "
      "| error in holes over RMS | left out: error over σ | s "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& surface : options.surfaces) {
    for (const std::string& layout : options.layouts) {
      std::vector<Metrics> all;
      for (int seed = 1; seed <= options.seeds; ++seed) {
        all.push_back(measure(surface, layout, seed, options));
        if (options.each) print_row(surface + " | " + layout + " " + std::to_string(seed), {all.back()});
      }
      print_row(surface + " | " + layout, all);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    bench::read_options(
        argc, argv,
        {{"--seeds", [&](auto value) { options.seeds = bench::seed_count(value); }},
         {"--surfaces", [&](auto value) { options.surfaces = bench::split_list(value); }},
         {"--layouts", [&](auto value) { options.layouts = bench::split_list(value); }},
         {"--shift-mm", [&](auto value) { options.shift_mm = bench::number_within(value, 0.0, 10.0); }},
         {"--set-shift", [&](auto value) { options.prior_shift_mm = bench::number_within(value, 0.0, 10.0); }},
         {"--each", [&](auto value) { options.each = bench::is_first(value, "yes", "no"); }}});
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "area_map: %s\n", error.what());
    return 1;
  }
}
