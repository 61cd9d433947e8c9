#include "demo_mesh.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/fidelity/check_renderer.h"
#include "asperity/fidelity/press_in_scan.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/recording/write_recording.h"
#include "asperity/registration/pose_error.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/our_folder.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/randomise_pose.h"
#include "asperity/simulation/simulate_recording.h"
#include "demo_metric.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
constexpr double kMeshUnit_m = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint64_t kSeed = 1;
constexpr const char* kScanned =
    "-0.034,-0.012,0.0158;-0.02,0.008,0.0243;0,0.016,0.0251;0.02,0.008,0.0243;0.034,-0.012,0.0158";

MeshFile pebble_in_millimetres() {
  const TriangleMesh pebble = make_pebble();
  MeshFile out;
  out.triangles = pebble.triangles;
  for (const Eigen::Vector3d& vertex_m : pebble.vertices_m) out.vertices.push_back(vertex_m / kMeshUnit_m);
  return out;
}

Scan scan_over(const TriangleMesh& mesh, SimulationConfig& config, const Observer& observer) {
  config = make_simulation_config("sandpaper", "open");
  config.hand.speed_mps = 0.025;
  config.shape.kind = BaseShapeKind::kMesh;
  config.shape.through = kScanned;
  randomise_pose(kSeed, config.shape);
  Scan scan;
  scan.name = "pebble";
  scan.recording = simulate_recording(config, *make_surface(config.surface, kSeed), mesh, observer);
  return scan;
}

std::vector<DemoMetric> compare_scans(const Recording& recording, const ScansOnMesh& result,
                                      const Pose& true_T_mesh_world, const ProcessConfig& config) {
  const RegisteredScan& scan = result.scans.front();
  const PoseError error = pose_error(result.placements.front().registration, true_T_mesh_world, scan.path.p_mesh_m);
  std::vector<DemoMetric> out;
  out.push_back({"pose_m", "pose, its points", "mm", 1e3, error.rms_m, error.sigma_m, DemoMetric::kNone, 0.0});
  out.push_back({"turn_rad", "pose, its rotation", "degrees", 1.0 / kDegree, error.rotation_rad, error.sigma_rad,
                 DemoMetric::kNone, 0.0});
  const Profile truth = true_profile(*recording.truth, config.profile);
  const RoughnessResult roughness = measure_roughness(truth.texture_m, truth.spacing_m, config.roughness);
  out.push_back(rq_metric(scan.process, roughness.Rq_m));
  if (scan.process.accuracy && scan.process.accuracy->profile) {
    const ProfileComparison& profile = *scan.process.accuracy->profile;
    out.push_back(
        {"correlation", "correlation", "", 1.0, profile.correlation, DemoMetric::kNone, DemoMetric::kNone, 1.0});
    out.push_back({"gain", "gain", "", 1.0, profile.gain, DemoMetric::kNone, DemoMetric::kNone, 1.0});
    out.push_back(length_error_metric(scan.process));
  }
  return out;
}

std::string undetermined_lines(const RegistrationResult& registration) {
  if (registration.undetermined.empty()) return "  undetermined        none\n";
  std::string out;
  for (const UndeterminedMotion& motion : registration.undetermined) {
    out += "  undetermined        " + motion.description + "\n";
  }
  return out;
}

// The other texture on the same pebble, beside the scanned one.
PaintResult paint_beside(Scene scene, const Texture& other, const fs::path& folder) {
  const std::vector<Eigen::Vector3d> picks_m{{-0.030, -0.026, -0.005}, {0.030, -0.026, -0.005}};
  HapticCoordinatesConfig config;
  config.half_width_mm = 4.0;
  PaintResult result = paint(scene.objects.front(), picks_m, {2, "protoboard.texture.json", other}, config);
  fs::create_directories(folder);
  write_scene(folder / "scene.json", scene);
  write_listing(folder);
  return result;
}

// The scan repeated by the renderer.
RendererCheck repeat_scan(const ScansOnMesh& result, const Scene& scene, const Observer& observer) {
  const RenderConfig config;
  const ProcessResult& measured = result.scans.front().process;
  const PressedScan pressed = press_in_scan(measured, scene, config.stiffness_N_per_m);
  constexpr double kServo_Hz = 1000.0;
  return check_renderer(measured, pressed, make_render_model(scene, config), kServo_Hz, RendererCheckConfig{},
                        observer);
}

}  // namespace

MeshDemo demonstrate_mesh(const fs::path& folder, const ProcessConfig& process, const Texture& other,
                          const Observer& observer) {
  const MeshFile file = pebble_in_millimetres();
  const TriangleMesh mesh = to_metres(file, kMeshUnit_m);
  write_obj(folder / "pebble.obj", file);
  SimulationConfig simulation;
  const Scan scan = scan_over(mesh, simulation, observer);
  const fs::path recording_folder = folder / "recordings" / "pebble", result_folder = folder / "results" / "pebble";
  fs::create_directories(recording_folder);
  fs::create_directories(result_folder);
  write_recording(recording_folder, *scan.recording);

  constexpr double kOff_m = 5e-3, kOff_rad = 5.0 * kDegree;
  const Pose truth = true_pose(*scan.recording).value();
  const Eigen::Vector3d middle_mesh_m =
      truth * Eigen::Vector3d(simulation.shape.centre_m[0], simulation.shape.centre_m[1], simulation.shape.centre_m[2]);
  const Pose guess = random_motion(kOff_m, kOff_rad, middle_mesh_m, kSeed) * truth;
  RegisterConfig config;
  config.process = process;
  const ScansOnMesh result = register_scans({scan}, mesh, guess, config, observer);
  write_registration(result_folder, result, {scan}, file, kMeshUnit_m);

  MeshDemo out;
  const std::vector<DemoMetric> metrics = compare_scans(*scan.recording, result, truth, process);
  out.json["registration"] = metrics_json(metrics);
  out.json["registration"]["undetermined"] = Json::array();
  for (const UndeterminedMotion& motion : result.placements.front().registration.undetermined) {
    out.json["registration"]["undetermined"].push_back(motion.description);
  }
  out.text = "sandpaper on a pebble, registered from 5 mm and 5 degrees off\n";
  for (const DemoMetric& metric : metrics) out.text += metric_line(metric);
  out.text += undetermined_lines(result.placements.front().registration);
  out.trustworthy = result.trustworthy;
  out.verdict = result.verdict;

  const Scene scene = make_scene(result, file, kMeshUnit_m);
  const RendererCheck check = repeat_scan(result, scene, observer);
  const std::vector<DemoMetric> repeated{
      {"correlation", "rendered, correlation", "", 1.0, check.correlation, DemoMetric::kNone, DemoMetric::kNone, 1.0},
      {"score", "renderer, score", "", 1.0, check.score, DemoMetric::kNone, DemoMetric::kNone, 1.0}};
  out.json["renderer_check"] = metrics_json(repeated);
  out.json["renderer_check"]["verdict"] = verdict_sentence(check.verdicts);
  for (const DemoMetric& metric : repeated) out.text += metric_line(metric);
  if (!check.trustworthy) {
    out.trustworthy = false;
    out.verdict += (out.verdict.empty() ? "" : "; ") + verdict_sentence(check.verdicts);
  }

  const PaintResult painted = paint_beside(scene, other, folder / "painted");
  const double length_m = painted.path.path.s_m.back();
  out.json["painted"] = {{"path_length_m", length_m},
                         {"triangles", painted.warp.triangles},
                         {"stretch_min", painted.warp.stretch_min},
                         {"stretch_max", painted.warp.stretch_max},
                         {"folded", painted.warp.folded.size()}};
  out.text += fmt::format(
      "the protoboard's texture painted next to it\n"
      "  {} triangles along {:.1f} mm; lengths from {:.3f} to {:.3f} of the true ones, {} triangles fold\n",
      painted.warp.triangles, length_m * 1e3, painted.warp.stretch_min, painted.warp.stretch_max,
      painted.warp.folded.size());
  return out;
}

}  // namespace asperity::app
