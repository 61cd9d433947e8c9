#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/length_unit_names.h"
#include "asperity/base/random.h"
#include "asperity/base/version.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/process_session.h"
#include "asperity/registration/register_path.h"
#include "asperity/scene/read_scene.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/simulate_recording.h"
#include "bench_render.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

using Eigen::Vector3d;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A point of the mesh, each triangle as likely as another.
struct SurfacePoint {
  Vector3d p_m, normal;
};
SurfacePoint random_point(const TriangleMesh& mesh, Random& random) {
  const auto t = static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.triangles.size()));
  const Triangle& corner = mesh.triangles[std::min(t, mesh.triangles.size() - 1)];
  const Vector3d &a = mesh.vertices_m[corner[0]], &b = mesh.vertices_m[corner[1]], &c = mesh.vertices_m[corner[2]];
  const double r = std::sqrt(random.uniform()), u = random.uniform();
  return {(1.0 - r) * a + r * (1.0 - u) * b + r * u * c, (b - a).cross(c - a).normalized()};
}

class BenchCommand : public Command {
 public:
  explicit BenchCommand(Parser& root)
      : Command(root, "bench", "Time this machine: closest points, registration, processing, rendering") {
    require(parser().add_option("WHAT", what_, "closest-point, register, process or render"))
        ->type_name("NAME")
        ->one_of({"closest-point", "register", "process", "render"});
    parser()
        .add_option("MESH,--mesh", mesh_,
                    "The mesh, or for render a scene; default: a generated mesh of some 70,000 triangles")
        ->type_name("FILE");
    parser()
        .add_option("--mesh-unit", mesh_unit_, "Unit of the mesh file: m (the default), mm or a length such as 0.06m")
        ->type_name("UNIT")
        ->suggest(length_unit_names());
    parser().add_option("--tip", tip_, "render: radius of the tip; default: a point")->type_name("LENGTH");
  }

  int run(const Observer& observer) override {
    if (!tip_.empty() && what_ != "render") throw UsageError("--tip: only the benchmark render has a tip");
    if (what_ == "process" && !mesh_.empty())
      throw UsageError("--mesh: the benchmark process has no mesh; leave the option out");
    Json out;
    out["format"] = "asperity-bench";
    out["version"] = 1;
    out["name"] = what_;
    observer.update(what_, 0.0);
    if (what_ == "closest-point") time_closest_points(out);
    if (what_ == "register") time_registration(out, observer);
    if (what_ == "process") time_processing(out, observer);
    if (what_ == "render") time_rendering(scene(), tip_.empty() ? 0.0 : length_option_m("--tip", tip_), out);
    observer.update(what_, 1.0);
    out["asperity"] = kVersion;
    print_json(out.dump(2));
    std::string text;
    for (const auto& [key, value] : out["figures"].items())
      text += fmt::format("{:<28} {:.4g}\n", key, value.get<double>());
    say(text);
    return kDone;
  }

 private:
  TriangleMesh mesh() const {
    if (!mesh_.empty()) {
      const MeshFile file = read_mesh(mesh_);
      if (mesh_unit_.empty()) refuse_unlikely_metres(file, mesh_);
      return to_metres(file, mesh_unit_.empty() ? 1.0 : unit_option_m("--mesh-unit", mesh_unit_));
    }
    PebbleConfig config;
    config.facet_m = 0.62e-3;
    return make_pebble(config);
  }

  Scene scene() const {
    if (mesh_.empty()) return make_render_bench();
    std::filesystem::path path(mesh_);
    if (std::filesystem::is_directory(path)) path /= "scene.json";
    Scene out = read_scene(path);
    if (!mesh_unit_.empty()) {
      out.objects.front().unit_m = unit_option_m("--mesh-unit", mesh_unit_);
    } else {
      refuse_unlikely_metres(out.objects.front().mesh, path);
    }
    return out;
  }

  // Nanoseconds a query, the median of five rounds.
  template <class Query>
  static double per_query_ns(const std::vector<Vector3d>& points, Query query) {
    constexpr int kRounds = 5;
    std::vector<double> rounds_ns;
    double sum_m = 0.0;
    for (int round = 0; round < kRounds; ++round) {
      const double took_s = seconds([&] {
        for (const Vector3d& p_m : points) sum_m += query(p_m);
      });
      rounds_ns.push_back(1e9 * took_s / static_cast<double>(points.size()));
    }
    // The sum is used, so that the compiler cannot leave the queries out.
    if (!(sum_m >= 0.0)) throw Error("bench: a closest-point query found no point");
    return median_of(rounds_ns);
  }

  void time_closest_points(Json& out) const {
    constexpr std::size_t kQueries = 100000;
    const TriangleMesh triangles = mesh();
    std::unique_ptr<MeshBvh> bvh;
    const double build_s = seconds([&] { bvh = std::make_unique<MeshBvh>(triangles); });
    Random random(1);
    Eigen::AlignedBox3d box;
    for (const Vector3d& v : triangles.vertices_m) box.extend(v);
    const double size_m = box.diagonal().norm();
    std::vector<Vector3d> near, anywhere, path;
    for (std::size_t i = 0; i < kQueries; ++i) {
      const SurfacePoint at = random_point(triangles, random);
      near.push_back(at.p_m + random.uniform(-0.01, 0.01) * size_m * at.normal);
      anywhere.push_back(box.min() +
                         Vector3d(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(box.diagonal()));
    }
    // Round the mesh at about its surface, in steps of a thousandth of its size.
    Vector3d along = near.front();
    Vector3d direction(1.0, 0.3, 0.2);
    while (path.size() < kQueries) {
      const ClosestPoint closest = bvh->closest_point(along);
      direction = (direction + 0.05 * Vector3d(random.normal(), random.normal(), random.normal())).normalized();
      along = closest.p_m + 1e-3 * size_m * direction;
      path.push_back(along);
    }
    const auto cold = [&](const Vector3d& p_m) { return bvh->closest_point(p_m).distance_m; };
    ClosestPoint previous = bvh->closest_point(path.front());
    const auto warm = [&](const Vector3d& p_m) { return (previous = bvh->closest_point(p_m, previous)).distance_m; };
    out["triangles"] = triangles.triangles.size();
    out["figures"] = {{"build_s", build_s},
                      {"memory_MB", 1e-6 * static_cast<double>(bvh->memory_bytes())},
                      {"near_ns", per_query_ns(near, cold)},
                      {"random_ns", per_query_ns(anywhere, cold)},
                      {"coherent_ns", per_query_ns(path, cold)},
                      {"warm_ns", per_query_ns(path, warm)}};
  }

  void time_registration(Json& out, const Observer& observer) const {
    constexpr int kStarts = 20;
    constexpr std::size_t kPoints = 2000;
    constexpr double kNoise_m = 0.15e-3, kShift_m = 5e-3, kTurn_rad = 0.0873;
    const MeshSurface surface(mesh());
    const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
    Random random(2);
    Eigen::AlignedBox3d box;
    for (const Vector3d& v : surface.mesh.vertices_m) box.extend(v);
    const Vector3d middle = box.center();
    MeasuredPath path;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double angle = 5.0 * static_cast<double>(i) / kPoints;
      const Vector3d towards = Vector3d(std::cos(angle), std::sin(angle), 0.5 * std::sin(2.0 * angle)).normalized();
      const Vector3d from = middle + box.diagonal().norm() * towards;
      const RayHit hit = surface.bvh.cast_ray(from, -towards);
      if (!hit.found()) continue;
      path.p_world_m.push_back(from - hit.t * towards +
                               kNoise_m * Vector3d(random.normal(), random.normal(), random.normal()));
    }
    std::vector<double> took_ms, error_m;
    for (int k = 0; k < kStarts; ++k) {
      observer.update("register", static_cast<double>(k) / kStarts);
      const Vector3d axis = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const Vector3d shift = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const Eigen::Quaterniond turn = exp_rotation(kTurn_rad * axis);
      const Pose guess{turn, turn * -middle + middle + kShift_m * shift};
      RegistrationResult result;
      took_ms.push_back(
          1e3 * seconds([&] { result = register_path(std::span(&path, 1), ready, guess, RegistrationConfig{}); }));
      double square = 0.0;
      for (const Vector3d& p_m : path.p_world_m) square += (result.T_mesh_world * p_m - p_m).squaredNorm();
      error_m.push_back(std::sqrt(square / static_cast<double>(path.p_world_m.size())));
    }
    out["triangles"] = surface.mesh.triangles.size();
    out["points"] = path.p_world_m.size();
    out["starts"] = kStarts;
    out["figures"] = {{"median_ms", median_of(took_ms)}, {"median_error_mm", 1e3 * median_of(error_m)}};
  }

  void time_processing(Json& out, const Observer& observer) const {
    SimulationConfig config = make_simulation_config("sandpaper", "open");
    config.hand.length_m = 0.2;
    const Recording recording = simulate_recording(config, observer);
    constexpr int kRounds = 5;
    std::vector<double> cold_s;
    for (int round = 0; round < kRounds; ++round) {
      cold_s.push_back(seconds([&] { process_recording(recording, {}, observer); }));
    }
    const double length_s = static_cast<double>(recording.probe.t_ns.back() - recording.probe.t_ns.front()) * 1e-9;
    out["samples"] = recording.probe.size();
    out["figures"] = {{"recording_s", length_s}, {"median_s", median_of(cold_s)}};
    time_changes(recording, kRounds, out, observer);
  }

  // What a person waits for after a change of one setting, a setting of each stage.
  static void time_changes(const Recording& recording, int rounds, Json& out, const Observer& observer) {
    using Change = std::pair<const char*, std::function<void(ProcessConfig&)>>;
    const std::vector<Change> changes{
        {"trajectory", [](ProcessConfig& c) { c.fused.gate_chi2 *= 1.01; }},
        {"contact", [](ProcessConfig& c) { c.base.contact.touch_N *= 1.01; }},
        {"base", [](ProcessConfig& c) { c.base.probe_axis_sigma_deg *= 1.01; }},
        {"profile", [](ProcessConfig& c) { c.profile.cutoff_cycles_per_mm *= 1.01; }},
        {"roughness", [](ProcessConfig& c) { c.roughness.max_missing *= 0.99; }},
        {"periodicity", [](ProcessConfig& c) { c.periodicity.min_strength *= 1.01; }},
        {"compliance", [](ProcessConfig& c) { c.compliance.min_force_N *= 1.01; }},
        {"stiffness", [](ProcessConfig& c) { c.stiffness.significance *= 1.01; }},
        {"texture", [](ProcessConfig& c) { c.texture.length_mm *= 0.99; }},
        {"accuracy", [](ProcessConfig& c) { c.comparison.low_cycles_per_mm *= 1.01; }},
        {"method_thesis", [](ProcessConfig& c) { c.method = ProcessMethods::method<ThesisMethod>(); }},
        {"nothing", [](ProcessConfig&) {}},
    };
    ProcessSession session(recording);
    for (const auto& [name, change] : changes) {
      std::vector<double> took_ms;
      for (int round = 0; round < rounds; ++round) {
        ProcessConfig config;
        session.process(config, observer);
        change(config);
        took_ms.push_back(1e3 * seconds([&] { session.process(config, observer); }));
      }
      out["figures"][std::string("change_") + name + "_ms"] = median_of(took_ms);
    }
  }

  std::string what_, mesh_, mesh_unit_, tip_;
};

}  // namespace

std::unique_ptr<Command> make_bench(Parser& root) { return std::make_unique<BenchCommand>(root); }

}  // namespace asperity::app
