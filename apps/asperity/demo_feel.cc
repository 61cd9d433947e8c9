#include "demo_feel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/device/servo_loop.h"
#include "asperity/pipeline/path_texture.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/feel_device.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_log.h"
#include "asperity/session/feel_settings.h"
#include "asperity/session/our_folder.h"
#include "demo_metric.h"
#include "feel_plot.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

constexpr double kUnit_m = 1e-3;
constexpr std::uint32_t kLong_mm = 120, kWide_mm = 20, kCell_mm = 2;

// Its face at z = 0, in millimetres.
MeshFile make_plate() {
  constexpr std::uint32_t kAlong = kLong_mm / kCell_mm, kAcross = kWide_mm / kCell_mm;
  MeshFile out;
  for (std::uint32_t j = 0; j <= kAcross; ++j) {
    for (std::uint32_t i = 0; i <= kAlong; ++i) out.vertices.emplace_back(i * kCell_mm, j * kCell_mm, 0.0);
  }
  for (std::uint32_t j = 0; j < kAcross; ++j) {
    for (std::uint32_t i = 0; i < kAlong; ++i) {
      const std::uint32_t a = j * (kAlong + 1) + i, above = a + kAlong + 1;
      out.triangles.push_back({a, a + 1, above + 1});
      out.triangles.push_back({a, above + 1, above});
    }
  }
  return out;
}

Scene lay_on_plate(const ProcessResult& protoboard) {
  Texture texture = protoboard.texture.value_or(Texture{});
  const PathTexture whole = fit_path_texture(protoboard.profile, FitFourier1dPathConfig{});
  texture.model = whole.series.fit.texture;
  texture.height_offset_m = whole.series.height_offset_m;
  texture.band_cycles_per_mm.reset();
  SceneObject plate;
  plate.mesh_file = "plate.obj";
  plate.unit_m = kUnit_m;
  plate.mesh = make_plate();
  const std::array<Eigen::Vector3d, 2> picks_m{Eigen::Vector3d(5e-3, 10e-3, 0.0), Eigen::Vector3d(115e-3, 10e-3, 0.0)};
  HapticCoordinatesConfig config;
  config.half_width_mm = 4.0;
  paint(plate, picks_m, {1, "protoboard.texture.json", std::move(texture)}, config);
  Scene scene;
  scene.objects.push_back(std::move(plate));
  return scene;
}

// What was felt on the way forth, over the plate's x.
struct Felt {
  std::vector<double> x_m, force_N, height_m;
};

Felt record_stroke(const Scene& scene, const fs::path& log_file, const Observer& observer) {
  FeelSettings settings;
  const FeelDrive drive = make_drive(scene, std::nullopt, std::nullopt, settings);
  const std::unique_ptr<HapticDevice> device = open_device("sim", drive, settings);
  SnapshotExchange<const RenderModel> model(
      std::make_unique<const RenderModel>(make_render_model(scene, settings.render_config())));
  FeelLog log(log_file, false);
  Felt out;
  bool forth = true;
  double farthest_m = -std::numeric_limits<double>::infinity();
  const std::atomic<bool> never{false};
  run_servo(*device, model, settings.servo, never, [&](const ServoTick& tick) {
    log.add(tick);
    if (tick.t_ns % 1'000'000'000 == 0) observer.update("feeling", 0.0);
    const double x_m = tick.p_world_m.x();
    constexpr double kTurn_m = 1e-3;
    farthest_m = std::max(farthest_m, x_m);
    forth = forth && x_m > farthest_m - kTurn_m;
    if (!forth || tick.t_ns < drive.stroke->starts_ns || !tick.output.contact.found()) return;
    out.x_m.push_back(x_m);
    out.force_N.push_back(tick.output.force_N.dot(tick.output.contact.normal_world));
    out.height_m.push_back(tick.output.texture_height_m);
  });
  log.commit();
  return out;
}

}  // namespace

FeelDemo demonstrate_feel(const fs::path& folder, const ProcessResult& protoboard, double true_pitch_m,
                          const Observer& observer) {
  const fs::path place = folder / "felt";
  fs::create_directories(place);
  const Scene scene = lay_on_plate(protoboard);
  write_scene(place / "scene.json", scene);
  const Felt felt = record_stroke(scene, place / "log.csv", observer);

  constexpr double kPlotSpacing_m = 0.05e-3, kHole_m = 1e-3;
  const std::array<std::span<const double>, 2> channels{felt.force_N, felt.height_m};
  const PathKnots knots = gather_knots(felt.x_m, channels, {}, 0.25 * kPlotSpacing_m);
  const auto [low, high] = std::minmax_element(felt.x_m.begin(), felt.x_m.end());
  // A texture's worth from either end: there the hand is still coming to speed.
  constexpr double kEnd_m = 5e-3;
  const auto first = std::llround((*low + kEnd_m) / kPlotSpacing_m);
  const std::size_t count = count_points(*high - *low - 2.0 * kEnd_m, kPlotSpacing_m);
  ForcePlot plot;
  plot.force_N = resample_linear(knots, 0, first, count, kPlotSpacing_m, kHole_m);
  const Periodicity pattern = find_periodicity(plot.force_N, kPlotSpacing_m, PeriodicityConfig{});

  plot.title = fmt::format("protoboard, rendered: force of a hand that presses with 1 N at 50 mm/s; pitch {:.3f} mm",
                           pattern.pitch_m * 1e3);
  plot.height_m = resample_linear(knots, 1, first, count, kPlotSpacing_m, kHole_m);
  plot.from_m = static_cast<double>(first) * kPlotSpacing_m;
  plot.spacing_m = kPlotSpacing_m;
  const std::size_t drawn = std::min<std::size_t>(count, 801);
  plot.force_N.resize(drawn);
  plot.height_m.resize(drawn);
  write_file(place / "force.svg", force_svg(plot));
  write_listing(place);

  FeelDemo out;
  const std::vector<DemoMetric> metrics{{"pitch_m", "pitch, from the force", "mm", 1e3, pattern.pitch_m,
                                         pattern.pitch_stderr_m, DemoMetric::kNone, true_pitch_m}};
  out.json = metrics_json(metrics);
  out.json["strength"] = pattern.strength;
  out.text = "the protoboard on a plate, stroked by a modelled hand\n";
  for (const DemoMetric& metric : metrics) out.text += metric_line(metric);
  if (!pattern.periodic) {
    out.trustworthy = false;
    out.verdict = "no pattern was found in the rendered force";
  }
  return out;
}

}  // namespace asperity::app
