// Scans of a mesh, simulated, registered from 5 mm and 5 degrees off, and compared with the truth: medians over
// several seeds, and the worst. Prints a table in Markdown; docs/accuracy-mesh.md says what it means.
//
//   mesh_accuracy [--seeds N] [--surfaces sandpaper,…] [--mesh FILE --unit M] [--length M] [--through POINTS]
//                 [--off-mm 5] [--off-deg 5] [--calibration stated|exact] [--coarse M] [--each yes]
//
// Without --mesh each seed has a pebble of its own. Without --through there are two paths: a straight stroke of
// --length (0.08) over the top, and, on the pebble, an arc of 90 mm. `exact` leaves out the errors of the probe's
// calibration, of which those of the tip's place (0.1 mm an axis) shift the pose. `--coarse` registers a pebble of
// facets of 0.4 mm to a mesh of it with facets of that length. `--each yes` adds a row a seed.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/registration/pose_error.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/randomise_pose.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr const char* kArc =
    "-0.034,-0.012,0.0158;-0.02,0.008,0.0243;0,0.016,0.0251;0.02,0.008,0.0243;0.034,-0.012,0.0158";

struct Options {
  int seeds = 10;
  std::vector<std::string> surfaces{"sandpaper", "protoboard", "clay_pot"};
  std::string mesh;
  double unit_m = 1.0;
  double length_m = 0.08;
  std::string through;
  double off_m = 5e-3;
  double off_rad = 5.0 * kDegree;
  bool exact = false;
  double coarse_m = 0.0;
  bool each = false;
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
       {"--mesh", [&](auto value) { out.mesh = value; }},
       {"--unit", [&](auto value) { out.unit_m = bench::number_within(value, 1e-9, 1e3); }},
       {"--length", [&](auto value) { out.length_m = bench::number_within(value, 1e-3, 10.0); }},
       {"--through", [&](auto value) { out.through = value; }},
       {"--off-mm", [&](auto value) { out.off_m = 1e-3 * bench::number_within(value, 0.0, 1e3); }},
       {"--off-deg", [&](auto value) { out.off_rad = kDegree * bench::number_within(value, 0.0, 180.0); }},
       {"--calibration", [&](auto value) { out.exact = bench::is_first(value, "exact", "stated"); }},
       {"--coarse", [&](auto value) { out.coarse_m = bench::number_within(value, 1e-4, 1e-1); }},
       {"--each", [&](auto value) { out.each = bench::is_first(value, "yes", "no"); }}});
  return out;
}

struct PathChoice {
  std::string name;
  std::string through;
};

struct PoseMetrics {
  double rms_mm, turn_deg, sigma_mm, sigma_deg, correlation, length_error_percent;
  bool turn_listed, trustworthy;
};

std::optional<PoseMetrics> measure_pose(const Options& options, const asperity::TriangleMesh& object,
                                        const asperity::TriangleMesh& mesh, const std::string& surface,
                                        const PathChoice& path, int seed) {
  const auto number = static_cast<std::uint64_t>(seed);
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, "open");
  config.seed = seed;
  config.hand.length_m = options.length_m;
  if (options.exact) config.calibration.imperfection = 0.0;
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  config.shape.through = path.through;
  asperity::randomise_pose(number, config.shape);
  asperity::Scan scan;
  scan.name = surface;
  scan.recording = asperity::simulate_recording(config, *asperity::make_surface(config.surface, number), object);
  const asperity::Pose truth = asperity::true_pose(*scan.recording).value();
  const Eigen::Vector3d middle_mesh_m =
      truth * Eigen::Vector3d(config.shape.centre_m[0], config.shape.centre_m[1], config.shape.centre_m[2]);
  const asperity::Pose guess = asperity::random_motion(options.off_m, options.off_rad, middle_mesh_m, number) * truth;

  const asperity::ScansOnMesh result = asperity::register_scans({scan}, mesh, guess, {});
  const asperity::RegisteredScan& registered = result.scans.front();
  if (registered.path.size() == 0 || !registered.process.accuracy || !registered.process.accuracy->profile) return {};
  const asperity::PoseError error =
      asperity::pose_error(result.placements.front().registration, truth, registered.path.p_mesh_m);
  const asperity::ProfileComparison& profile = *registered.process.accuracy->profile;
  return PoseMetrics{1e3 * error.rms_m,
                     error.rotation_rad / kDegree,
                     1e3 * error.sigma_m,
                     error.sigma_rad / kDegree,
                     profile.correlation,
                     std::abs(profile.length_error_percent),
                     !result.placements.front().registration.undetermined.empty(),
                     result.trustworthy};
}

template <class Get>
std::vector<double> all(const std::vector<PoseMetrics>& metrics, Get get) {
  std::vector<double> out;
  for (const PoseMetrics& one : metrics) out.push_back(get(one));
  return out;
}

void print_row(const std::string& name, const std::vector<PoseMetrics>& metrics, int seeds) {
  if (metrics.empty()) {
    std::printf("| %s | | | | | | | | %d |\n", name.c_str(), seeds);
    return;
  }
  const auto rms = all(metrics, [](const PoseMetrics& f) { return f.rms_mm; });
  const auto turn = all(metrics, [](const PoseMetrics& f) { return f.turn_deg; });
  const auto sigma = all(metrics, [](const PoseMetrics& f) { return f.sigma_mm; });
  const auto sigma_deg = all(metrics, [](const PoseMetrics& f) { return f.sigma_deg; });
  const auto correlation = all(metrics, [](const PoseMetrics& f) { return f.correlation; });
  const auto length = all(metrics, [](const PoseMetrics& f) { return f.length_error_percent; });
  const auto listed = std::count_if(metrics.begin(), metrics.end(), [](const PoseMetrics& f) { return f.turn_listed; });
  const auto doubted =
      std::count_if(metrics.begin(), metrics.end(), [](const PoseMetrics& f) { return !f.trustworthy; });
  std::printf("| %s | %.3f (%.3f) | %.3f | %.2f (%.2f) | %.2f | %.3f (%.3f) | %.2f (%.2f) | %d | %d |\n", name.c_str(),
              asperity::median(rms), *std::max_element(rms.begin(), rms.end()), asperity::median(sigma),
              asperity::median(turn), *std::max_element(turn.begin(), turn.end()), asperity::median(sigma_deg),
              asperity::median(correlation), *std::min_element(correlation.begin(), correlation.end()),
              asperity::median(length), *std::max_element(length.begin(), length.end()), static_cast<int>(listed),
              static_cast<int>(doubted) + seeds - static_cast<int>(metrics.size()));
  std::fflush(stdout);
}

void run(const Options& options) {
  std::printf(
      "| surface | path | points moved, mm | its σ | rotated, ° | its σ | correlation | length error, %% | "
      "undetermined "
      "| invalid |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<PathChoice> paths;
  if (options.through.empty()) paths.push_back({"straight", ""});
  if (options.through.empty() && options.mesh.empty()) paths.push_back({"arc", kArc});
  if (!options.through.empty()) paths.push_back({"given", options.through});
  std::optional<asperity::TriangleMesh> given;
  if (!options.mesh.empty()) given = asperity::to_metres(asperity::read_mesh(options.mesh), options.unit_m);
  for (const std::string& surface : options.surfaces) {
    for (const PathChoice& path : paths) {
      const std::string name = surface + " | " + path.name;
      std::vector<PoseMetrics> metrics;
      for (int seed = 1; seed <= options.seeds; ++seed) {
        asperity::PebbleConfig pebble;
        pebble.seed = seed;
        asperity::TriangleMesh mesh = given ? *given : asperity::make_pebble(pebble), object = mesh;
        if (options.coarse_m > 0.0 && !given) {
          pebble.facet_m = 0.4e-3;
          object = asperity::make_pebble(pebble);
          pebble.facet_m = options.coarse_m;
          mesh = asperity::make_pebble(pebble);
        }
        const auto one = measure_pose(options, object, mesh, surface, path, seed);
        if (one && options.each) print_row(name + ", seed " + std::to_string(seed), {*one}, 1);
        if (one) metrics.push_back(*one);
      }
      print_row(name, metrics, options.seeds);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_accuracy: %s\n", error.what());
    return 1;
  }
}
