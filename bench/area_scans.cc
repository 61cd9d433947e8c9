// A rough patch of the bench's pebble scanned by strokes that are parallel and cross, each a simulated recording, all
// registered together to the pebble without its relief, made into an area, and compared with the relief under the tip.
// Prints a table in Markdown; docs/areas.md says what it means.
//
//   area_scans [--seeds N] [--lanes 10] [--pitch-mm 0.8] [--length-mm 16] [--calibration stated|exact] [--guess-mm 0.3]
//              [--guess-sigma-mm 10] [--locators 0] [--placement auto|same]
//              [--relief yes|no] [--positions measured|true|shifted] [--shift-mm 0] [--save FOLDER]
//
// `--positions true` maps the measured heights at the tips' true places, `shifted` at the measured places less each
// stroke's mean error: what a fit of one shift a stroke could reach. `--shift-mm` is map.shift_mm.
//
// `--locators N` adds N bent strokes of some 90 mm over the smooth pebble, which are registered with the rest and are
// no part of the map: they hold what the strokes over the patch leave open. `--placement same` states that the object
// did not move, `auto` leaves that to be found.
//
// `--guess-sigma-mm` is refinement.guess_sigma_m, with as many degrees: how well the guess is said to be known.
//
// `--relief no`: the patch is as smooth as the mesh, and no area may come of it. `--save` keeps what `register` would
// write of the first seed, for `asperity area`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "area/compare_map.h"
#include "area/rough_patch.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

struct Options {
  int seeds = 1;
  int lanes = 10;
  double pitch_m = 0.8e-3;
  double length_m = 16e-3;
  double guess_m = 0.3e-3;
  double guess_sigma_mm = 10.0;
  int locators = 0;
  bool found_placements = true;
  bool exact = false;
  bool relief = true;
  std::string positions = "measured";
  double shift_mm = 0.0;
  std::string save;
};

// What a stroke's places on the mesh are wrong by: the mean, and the RMS about it, mm.
struct PlaceError {
  Vector3d mean_m = Vector3d::Zero();
  double rms_m = 0.0;
};

// Where the tip truly was at a path's points, by the times at which the base path was there, on the mesh. The stroke's
// path becomes that, or its own less the mean error.
PlaceError correct_places(const asperity::RegisteredScan& scan, const asperity::Recording& recording,
                          const asperity::MeshSurface& surface, const std::string& positions,
                          asperity::MeshPath& path) {
  const asperity::BasePath& base = scan.process.base.path;
  const std::vector<std::int64_t>& t_ns = scan.process.trajectory.motion.t_ns;
  const asperity::Truth& truth = *recording.truth;
  const asperity::Pose T_mesh_world = asperity::true_pose(recording).value();
  std::vector<Vector3d> true_m;
  std::size_t sample = 0, at = 0;
  for (const double s_m : path.s_m) {
    while (sample + 1 < base.size() && base.s_m[sample] < s_m) ++sample;
    while (at + 1 < truth.size() && truth.t_ns[at] < t_ns[sample]) ++at;
    true_m.push_back(surface.bvh.closest_point(T_mesh_world * truth.p_world_tip_m[at]).p_m);
  }
  PlaceError out;
  const double count = static_cast<double>(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) out.mean_m += (path.p_mesh_m[i] - true_m[i]) / count;
  for (std::size_t i = 0; i < path.size(); ++i)
    out.rms_m += (path.p_mesh_m[i] - true_m[i] - out.mean_m).squaredNorm() / count;
  out.rms_m = std::sqrt(out.rms_m);
  if (positions == "measured") return out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d p_m = positions == "true" ? true_m[i] : Vector3d(path.p_mesh_m[i] - out.mean_m);
    const asperity::ClosestPoint closest = surface.bvh.closest_point(p_m);
    path.p_mesh_m[i] = closest.p_m;
    path.triangle[i] = closest.triangle;
  }
  return out;
}

std::string text_of(const Vector3d& p) {
  std::ostringstream out;
  out.precision(9);
  out << p.x() << ',' << p.y() << ',' << p.z();
  return out.str();
}

// Over the upper side of the bench's pebble, each in a direction of its own, bent to one side.
std::string locator(int number) {
  const double turn = 2.4 * number;
  std::string out;
  for (int k = -2; k <= 2; ++k) {
    const double along = 0.45 * k, aside = 0.25 - 0.12 * k * k;
    const double x = std::cos(turn) * along - std::sin(turn) * aside,
                 y = std::sin(turn) * along + std::cos(turn) * aside;
    const double z = std::sqrt(std::max(0.05, 1.0 - x * x - y * y));
    out += (out.empty() ? "" : ";") + text_of(Vector3d(0.045 * x, 0.036 * y, 0.028 * z));
  }
  return out;
}

void run_seed(const Options& options, int seed) {
  asperity::PebbleConfig shape;
  shape.seed = seed;
  const asperity::TriangleMesh mesh = asperity::make_pebble(shape);
  const asperity::MeshSurface pebble(mesh);
  const double half_m = 0.5 * options.length_m + 6e-3;
  const bench::Relief relief(static_cast<std::uint64_t>(seed), options.relief ? 40e-6 : 0.0);
  const asperity::TriangleMesh ground = bench::rough_top(pebble, relief, half_m);

  asperity::SimulationConfig config = asperity::make_simulation_config("sine", "open");
  config.surface.amplitude_m = 0.0;
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  config.shape.mesh_pose = asperity::MeshPose::kGiven;
  if (options.exact) config.calibration.imperfection = 0.0;
  const auto vector = [](const std::array<double, 3>& a) { return Vector3d(a[0], a[1], a[2]); };
  const Vector3d normal = vector(config.shape.normal).normalized();
  Vector3d direction = vector(config.shape.stroke_direction);
  direction = (direction - normal * normal.dot(direction)).normalized();
  Eigen::Matrix3d R;
  R << direction, normal.cross(direction), normal;
  const Eigen::AngleAxisd turn(R);
  const Vector3d top(0.0, 0.0, 0.1 - pebble.bvh.cast_ray({0, 0, 0.1}, {0, 0, -1}).t);
  const Vector3d position = vector(config.shape.centre_m) - R * top;
  for (int axis = 0; axis < 3; ++axis) {
    config.shape.mesh_position_m[static_cast<std::size_t>(axis)] = position[axis];
    config.shape.mesh_rotation_rad[static_cast<std::size_t>(axis)] = turn.angle() * turn.axis()[axis];
  }
  const auto on_ground = [&](double x, double y) {
    return Vector3d(x, y, 0.1 - pebble.bvh.cast_ray({x, y, 0.1}, {0, 0, -1}).t);
  };
  const std::clock_t begin = std::clock();
  std::vector<asperity::Scan> scans;
  const auto flat = asperity::make_surface(config.surface, 1);
  const auto simulate = [&](const std::string& name, const asperity::TriangleMesh& over) {
    asperity::Scan scan;
    scan.name = name;
    if (!options.found_placements) scan.placement = 1;
    scan.recording = asperity::simulate_recording(config, *flat, over);
    scans.push_back(std::move(scan));
  };
  for (int k = 0; k < 2 * options.lanes; ++k) {
    const double lane = (k % options.lanes - 0.5 * (options.lanes - 1)) * options.pitch_m,
                 half = 0.5 * options.length_m;
    const bool across = k >= options.lanes;
    config.seed = 100 * seed + k;
    config.shape.through = across ? text_of(on_ground(lane, -half)) + ";" + text_of(on_ground(lane, half))
                                  : text_of(on_ground(-half, lane)) + ";" + text_of(on_ground(half, lane));
    simulate("scan" + std::to_string(k + 1), ground);
  }
  const std::size_t over_patch = scans.size();
  for (int k = 0; k < options.locators; ++k) {
    config.seed = 100 * seed + 2 * options.lanes + k;
    config.shape.through = locator(k);
    simulate("locator" + std::to_string(k + 1), mesh);
  }
  const std::clock_t simulated = std::clock();
  const asperity::Pose truth = asperity::true_pose(*scans.front().recording).value();
  const asperity::Pose guess =
      asperity::random_motion(options.guess_m, 0.3 / 180.0 * kPi, vector(config.shape.centre_m),
                              static_cast<std::uint64_t>(seed)) *
      truth;
  asperity::RegisterConfig register_config;
  register_config.refinement.guess_sigma_m = 1e-3 * options.guess_sigma_mm;
  register_config.refinement.guess_sigma_deg = options.guess_sigma_mm;
  const asperity::ScansOnMesh registered = asperity::register_scans(scans, mesh, guess, register_config);
  const std::clock_t laid = std::clock();
  if (!options.save.empty()) {
    std::filesystem::create_directories(options.save);
    asperity::MeshFile file;
    file.vertices = mesh.vertices_m;
    file.triangles = mesh.triangles;
    asperity::write_registration(options.save, registered, scans, file, 1.0);
  }
  std::vector<asperity::AreaScan> strokes;
  std::vector<double> constant_mm, about_mm;
  for (std::size_t k = 0; k < over_patch; ++k) {
    const asperity::RegisteredScan& scan = registered.scans[k];
    if (scan.path.size() < 2 || scan.process.profile.size() < 2) continue;
    if (!asperity::is_trustworthy(scan.process.verdicts)) continue;
    strokes.push_back({scan.name, scan.path, scan.process.profile});
    const PlaceError error = correct_places(scan, *scans[k].recording, pebble, options.positions, strokes.back().path);
    constant_mm.push_back(1e3 * error.mean_m.norm());
    about_mm.push_back(1e3 * error.rms_m);
  }
  asperity::AreaConfig area_config;
  area_config.map.shift_mm = options.shift_mm;
  // As `asperity area` judges it: what is invalid in a scan alone leaves that scan out.
  bool held = true;
  for (const asperity::Placement& placement : registered.placements)
    held = held && asperity::is_trustworthy(placement.verdicts);
  const asperity::AreaResult area = asperity::make_area(mesh, strokes, held, area_config);
  const std::clock_t mapped = std::clock();
  const auto seconds = [](std::clock_t from, std::clock_t to) {
    return static_cast<double>(to - from) / CLOCKS_PER_SEC;
  };
  const asperity::StrokeMap& map = area.map;
  std::printf("| %d | %d | %zu | %.3f | %.3f | %.2f ± %.2f | %.2f | ", seed, static_cast<int>(strokes.size()),
              registered.placements.size(), constant_mm.empty() ? 0.0 : asperity::median(constant_mm),
              about_mm.empty() ? 0.0 : asperity::median(about_mm), map.agreement, map.agreement_sigma, area.covered);
  if (map.texture.supported.empty() || area.triangle.empty()) {
    std::printf("| | | | | | ");
  } else {
    const bench::UnderTip under(relief, scans.front().recording->calibration.tip_radius_m, half_m);
    const std::vector<bench::MapPoint> points = bench::map_points(area, mesh);
    const bench::Comparison placed = bench::compare(points, under, Vector2d::Zero());
    bench::Comparison best;
    Vector2d at = Vector2d::Zero();
    for (double reach = 0.4e-3; reach > 5e-6; reach *= 0.5) {
      const Vector2d centre = at;
      for (int dx = -2; dx <= 2; ++dx) {
        for (int dy = -2; dy <= 2; ++dy) {
          const Vector2d shift = centre + 0.5 * reach * Vector2d(dx, dy);
          const bench::Comparison one = bench::compare(points, under, shift);
          if (one.error_m < best.error_m) {
            best = one;
            at = shift;
          }
        }
      }
    }
    std::printf("%.1f | %.1f | %.1f | %.2f | %.2f | %.3f, %.3f | ", 1e6 * placed.truth_m, 1e6 * placed.error_m,
                1e6 * best.error_m, best.ratio, best.correlation, 1e3 * at.x(), 1e3 * at.y());
  }
  std::printf("%.1f | %.2f | %.0f, %.0f, %.1f | %s |\n", 1e6 * map.sigma_rms_m, map.held_out.error_over_sigma,
              seconds(begin, simulated), seconds(simulated, laid), seconds(laid, mapped),
              area.verdict.empty() ? "valid" : area.verdict.c_str());
  for (const asperity::Verdict& verdict : registered.verdicts)
    std::fprintf(stderr, "%s: %s\n", verdict.code.c_str(), verdict.message.c_str());
  std::fflush(stdout);
}

void run(const Options& options) {
  std::printf(
      "| seed | strokes | placements | position error of a stroke, mm | its drift, mm | shared | covered | "
      "surface RMS, µm | error RMS, µm | after the shift | error over σ | correlation | shift x, y, mm | σ, µm "
      "| left out: error over σ | s: simulate, register, map | verdict |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int seed = 1; seed <= options.seeds; ++seed) run_seed(options, seed);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    bench::read_options(
        argc, argv,
        {{"--seeds", [&](auto value) { options.seeds = bench::seed_count(value); }},
         {"--lanes", bench::whole_into(options.lanes, 2, 100)},
         {"--pitch-mm", [&](auto value) { options.pitch_m = 1e-3 * bench::number_within(value, 0.05, 20); }},
         {"--length-mm", [&](auto value) { options.length_m = 1e-3 * bench::number_within(value, 12, 40); }},
         {"--guess-sigma-mm", [&](auto value) { options.guess_sigma_mm = bench::number_within(value, 1e-3, 1e3); }},
         {"--locators", bench::whole_into(options.locators, 0, 20)},
         {"--placement", [&](auto value) { options.found_placements = bench::is_first(value, "auto", "same"); }},
         {"--guess-mm", [&](auto value) { options.guess_m = 1e-3 * bench::number_within(value, 0, 100); }},
         {"--calibration", [&](auto value) { options.exact = bench::is_first(value, "exact", "stated"); }},
         {"--relief", bench::yes_into(options.relief)},
         {"--positions", bench::text_into(options.positions)},
         {"--shift-mm", bench::number_into(options.shift_mm, 0.0, 10.0)},
         {"--save", [&](auto value) { options.save = value; }}});
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "area_scans: %s\n", error.what());
    return 1;
  }
}
