// A rough patch of the bench's pebble scanned by strokes that are parallel and cross, each a simulated recording, all
// registered together to the pebble without its relief, made into an area, and compared with the relief under the tip.
// Prints a table in Markdown; docs/areas.md says what it means.
//
//   area_scans [--seeds N] [--lanes 10] [--pitch-mm 0.8] [--length-mm 16] [--calibration stated|exact] [--guess-mm 0.3]
//              [--guess-sigma-mm 10]
//              [--relief yes|no] [--positions measured|true|shifted] [--shift-mm 0] [--save FOLDER]
//
// `--positions true` maps the measured heights at the tips' true places, `shifted` at the measured places less each
// stroke's mean error: what a fit of one shift a stroke could reach. `--shift-mm` is map.shift_mm.
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
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "asperity/base/random.h"
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
#include "asperity/texture/evaluate_spline_grid.h"
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
  bool exact = false;
  bool relief = true;
  std::string positions = "measured";
  double shift_mm = 0.0;
  std::string save;
};

// 0.25 to 1 cycles/mm in all directions, 40 µm RMS, over the mesh's x and y.
class Relief {
 public:
  explicit Relief(std::uint64_t seed, double rms_m) {
    asperity::Random random(seed, 7);
    constexpr int kWaves = 200;
    for (int i = 0; i < kWaves; ++i) {
      const double f = 250.0 * std::pow(4.0, random.uniform(0.0, 1.0)), angle = random.uniform(0.0, 2.0 * kPi);
      waves_.push_back(
          {2.0 * kPi * f * std::cos(angle), 2.0 * kPi * f * std::sin(angle), random.uniform(0.0, 2.0 * kPi)});
    }
    height_m_ = rms_m * std::sqrt(2.0 / kWaves);
  }
  double at(double x_m, double y_m) const {
    double out = 0.0;
    for (const Vector3d& w : waves_) out += height_m_ * std::cos(w.x() * x_m + w.y() * y_m + w.z());
    return out;
  }

 private:
  std::vector<Vector3d> waves_;
  double height_m_ = 0.0;
};

// The pebble's top as a grid of 0.1 mm with the relief along its normals.
asperity::TriangleMesh rough_top(const asperity::MeshSurface& pebble, const Relief& relief, double half_m) {
  asperity::TriangleMesh out;
  constexpr double kSpacing_m = 0.1e-3;
  const int n = static_cast<int>(std::ceil(2.0 * half_m / kSpacing_m));
  for (int r = 0; r <= n; ++r) {
    for (int c = 0; c <= n; ++c) {
      const double x = -half_m + c * kSpacing_m, y = -half_m + r * kSpacing_m;
      const asperity::RayHit hit = pebble.bvh.cast_ray({x, y, 0.1}, {0.0, 0.0, -1.0});
      const auto& normals = pebble.normals[hit.triangle];
      const Vector3d n_mesh =
          (hit.barycentric[0] * normals[0] + hit.barycentric[1] * normals[1] + hit.barycentric[2] * normals[2])
              .normalized();
      out.vertices_m.push_back(Vector3d(x, y, 0.1 - hit.t) + relief.at(x, y) * n_mesh);
    }
  }
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      const auto a = static_cast<std::uint32_t>(r * (n + 1) + c), up = a + static_cast<std::uint32_t>(n) + 1;
      out.triangles.push_back({a, a + 1, up + 1});
      out.triangles.push_back({a, up + 1, up});
    }
  }
  return out;
}

// The relief as a ball rolls over it: its dilation on a grid of 0.05 mm, taken at the nearest point.
class UnderTip {
 public:
  UnderTip(const Relief& relief, double radius_m, double half_m) : half_m_(half_m) {
    n_ = static_cast<int>(std::ceil(2.0 * half_m / kSpacing_m)) + 1;
    std::vector<double> z(static_cast<std::size_t>(n_ * n_));
    for (int r = 0; r < n_; ++r)
      for (int c = 0; c < n_; ++c) z[place(r, c)] = relief.at(-half_m + c * kSpacing_m, -half_m + r * kSpacing_m);
    height_m_ = z;
    const int reach = std::min(static_cast<int>(radius_m / kSpacing_m), 12);  // slopes are below 0.6
    for (int dr = -reach; dr <= reach; ++dr) {
      for (int dc = -reach; dc <= reach; ++dc) {
        const double u2 = (dr * dr + dc * dc) * kSpacing_m * kSpacing_m;
        if (u2 > radius_m * radius_m) continue;
        const double ball = std::sqrt(radius_m * radius_m - u2) - radius_m;
        for (int r = std::max(0, -dr); r < std::min(n_, n_ - dr); ++r)
          for (int c = std::max(0, -dc); c < std::min(n_, n_ - dc); ++c)
            height_m_[place(r, c)] = std::max(height_m_[place(r, c)], z[place(r + dr, c + dc)] + ball);
      }
    }
  }
  double at(double x_m, double y_m) const {
    const double u = std::clamp((x_m + half_m_) / kSpacing_m, 0.0, n_ - 1.001);
    const double v = std::clamp((y_m + half_m_) / kSpacing_m, 0.0, n_ - 1.001);
    const int c = static_cast<int>(u), r = static_cast<int>(v);
    const double a = u - c, b = v - r;
    return (1 - b) * ((1 - a) * height_m_[place(r, c)] + a * height_m_[place(r, c + 1)]) +
           b * ((1 - a) * height_m_[place(r + 1, c)] + a * height_m_[place(r + 1, c + 1)]);
  }

 private:
  static constexpr double kSpacing_m = 0.05e-3;
  std::size_t place(int r, int c) const { return static_cast<std::size_t>(r * n_ + c); }
  double half_m_;
  int n_ = 0;
  std::vector<double> height_m_;
};

struct MapPoint {
  Vector3d p_mesh_m;
  double height_m, sigma_m;
  bool covered;
};

// Points of the textured triangles, a few each, with the map's heights there.
std::vector<MapPoint> map_points(const asperity::AreaResult& area, const asperity::TriangleMesh& mesh) {
  std::vector<MapPoint> out;
  const asperity::ArealTexture& texture = area.map.texture;
  const asperity::SplineGrid& g = texture.surface;
  for (std::size_t i = 0; i < area.triangle.size(); ++i) {
    const asperity::Triangle& v = mesh.triangles[area.triangle[i]];
    constexpr int kParts = 8;
    for (int a = 0; a < kParts; ++a) {
      for (int b = 0; a + b < kParts; ++b) {
        const Vector3d w((a + 1.0 / 3.0) / kParts, (b + 1.0 / 3.0) / kParts, 0.0);
        const Vector3d weight(w[0], w[1], 1.0 - w[0] - w[1]);
        MapPoint point;
        point.p_mesh_m.setZero();
        Vector2d xy_m = Vector2d::Zero();
        for (int c = 0; c < 3; ++c) {
          const auto corner = static_cast<std::size_t>(c);
          point.p_mesh_m += weight[c] * mesh.vertices_m[v[corner]];
          xy_m += 1e-3 * weight[c] * area.coordinates[i].xy_mm[corner];
        }
        const double u = std::round((xy_m.x() - g.origin_x_m) / g.spacing_x_m),
                     t = std::round((xy_m.y() - g.origin_y_m) / g.spacing_y_m);
        if (u < 0 || t < 0 || u >= static_cast<double>(g.columns) || t >= static_cast<double>(g.rows)) continue;
        const std::size_t at = static_cast<std::size_t>(t) * g.columns + static_cast<std::size_t>(u);
        point.height_m = asperity::evaluate_height(g, xy_m.x(), xy_m.y()).height_m;
        point.sigma_m = texture.sigma_m[at];
        point.covered = texture.supported[at] != 0;
        out.push_back(point);
      }
    }
  }
  return out;
}

struct Comparison {
  double error_m = std::numeric_limits<double>::infinity(), ratio = 0.0, sigma_m = 0.0, truth_m = 0.0,
         correlation = 0.0;
};

// Map less truth, the truth moved by `shift_m`, a quadratic over the patch taken off: that is the pose's share and the
// mesh's, below the map's band.
Comparison compare(const std::vector<MapPoint>& points, const UnderTip& truth, const Vector2d& shift_m) {
  std::vector<const MapPoint*> used;
  for (const MapPoint& p : points)
    if (p.covered) used.push_back(&p);
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd basis(n, 6);
  Eigen::VectorXd error(n), z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const MapPoint& p = *used[static_cast<std::size_t>(i)];
    const double x = p.p_mesh_m.x(), y = p.p_mesh_m.y(), u = 100.0 * x, v = 100.0 * y;
    basis.row(i) << 1.0, u, v, u * u, u * v, v * v;
    z[i] = truth.at(x + shift_m.x(), y + shift_m.y());
    error[i] = p.height_m - z[i];
  }
  error -= basis * (basis.transpose() * basis).ldlt().solve(basis.transpose() * error);
  Eigen::VectorXd map = error + z;
  Comparison out;
  double ratio = 0.0, sigma = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = used[static_cast<std::size_t>(i)]->sigma_m;
    ratio += std::pow(error[i] / s, 2);
    sigma += s * s;
  }
  const auto count = static_cast<double>(n);
  out.error_m = std::sqrt(error.squaredNorm() / count);
  out.ratio = std::sqrt(ratio / count);
  out.sigma_m = std::sqrt(sigma / count);
  z.array() -= z.mean();
  map.array() -= map.mean();
  out.truth_m = std::sqrt(z.squaredNorm() / count);
  out.correlation = map.dot(z) / (map.norm() * z.norm());
  return out;
}

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

void run_seed(const Options& options, int seed) {
  asperity::PebbleConfig shape;
  shape.seed = seed;
  const asperity::TriangleMesh mesh = asperity::make_pebble(shape);
  const asperity::MeshSurface pebble(mesh);
  const double half_m = 0.5 * options.length_m + 6e-3;
  const Relief relief(static_cast<std::uint64_t>(seed), options.relief ? 40e-6 : 0.0);
  const asperity::TriangleMesh ground = rough_top(pebble, relief, half_m);

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
  for (int k = 0; k < 2 * options.lanes; ++k) {
    const double lane = (k % options.lanes - 0.5 * (options.lanes - 1)) * options.pitch_m,
                 half = 0.5 * options.length_m;
    const bool across = k >= options.lanes;
    config.seed = 100 * seed + k;
    config.shape.through = across ? text_of(on_ground(lane, -half)) + ";" + text_of(on_ground(lane, half))
                                  : text_of(on_ground(-half, lane)) + ";" + text_of(on_ground(half, lane));
    asperity::Scan scan;
    scan.name = "scan" + std::to_string(k + 1);
    scan.recording = asperity::simulate_recording(config, *flat, ground);
    scans.push_back(std::move(scan));
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
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const asperity::RegisteredScan& scan = registered.scans[k];
    if (scan.path.size() < 2 || scan.process.profile.size() < 2) continue;
    strokes.push_back({scan.name, scan.path, scan.process.profile});
    const PlaceError error = correct_places(scan, *scans[k].recording, pebble, options.positions, strokes.back().path);
    constant_mm.push_back(1e3 * error.mean_m.norm());
    about_mm.push_back(1e3 * error.rms_m);
  }
  asperity::AreaConfig area_config;
  area_config.map.shift_mm = options.shift_mm;
  const asperity::AreaResult area = asperity::make_area(mesh, strokes, registered.trustworthy, area_config);
  const std::clock_t mapped = std::clock();
  const auto seconds = [](std::clock_t from, std::clock_t to) {
    return static_cast<double>(to - from) / CLOCKS_PER_SEC;
  };
  const asperity::StrokeMap& map = area.map;
  std::printf("| %d | %d | %.3f | %.3f | %.2f ± %.2f | %.2f | ", seed, 2 * options.lanes,
              constant_mm.empty() ? 0.0 : asperity::median(constant_mm),
              about_mm.empty() ? 0.0 : asperity::median(about_mm), map.agreement, map.agreement_sigma, area.covered);
  if (map.texture.supported.empty() || area.triangle.empty()) {
    std::printf("| | | | | | ");
  } else {
    const UnderTip under(relief, scans.front().recording->calibration.tip_radius_m, half_m);
    const std::vector<MapPoint> points = map_points(area, mesh);
    const Comparison placed = compare(points, under, Vector2d::Zero());
    Comparison best;
    Vector2d at = Vector2d::Zero();
    for (double reach = 0.4e-3; reach > 5e-6; reach *= 0.5) {
      const Vector2d centre = at;
      for (int dx = -2; dx <= 2; ++dx) {
        for (int dy = -2; dy <= 2; ++dy) {
          const Vector2d shift = centre + 0.5 * reach * Vector2d(dx, dy);
          const Comparison one = compare(points, under, shift);
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
  std::fflush(stdout);
}

void run(const Options& options) {
  std::printf(
      "| seed | strokes | places of a stroke wrong by, mm | wander about that, mm | shared | covered | surface RMS, µm "
      "| error RMS, µm | the same, moved | error over σ | "
      "correlation | moved "
      "by x, y, mm | σ, µm | left out: error over σ | s: simulate, register, map | verdict |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int seed = 1; seed <= options.seeds; ++seed) run_seed(options, seed);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    bench::read_options(
        argc, argv,
        {{"--seeds", [&](auto value) { options.seeds = bench::seed_count(value); }},
         {"--lanes", [&](auto value) { options.lanes = static_cast<int>(bench::number_within(value, 2, 100)); }},
         {"--pitch-mm", [&](auto value) { options.pitch_m = 1e-3 * bench::number_within(value, 0.05, 20); }},
         {"--length-mm", [&](auto value) { options.length_m = 1e-3 * bench::number_within(value, 12, 40); }},
         {"--guess-sigma-mm", [&](auto value) { options.guess_sigma_mm = bench::number_within(value, 1e-3, 1e3); }},
         {"--guess-mm", [&](auto value) { options.guess_m = 1e-3 * bench::number_within(value, 0, 100); }},
         {"--calibration", [&](auto value) { options.exact = bench::is_first(value, "exact", "stated"); }},
         {"--relief", [&](auto value) { options.relief = bench::is_first(value, "yes", "no"); }},
         {"--positions", [&](auto value) { options.positions = std::string(value); }},
         {"--shift-mm", [&](auto value) { options.shift_mm = bench::number_within(value, 0.0, 10.0); }},
         {"--save", [&](auto value) { options.save = value; }}});
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "area_scans: %s\n", error.what());
    return 1;
  }
}
