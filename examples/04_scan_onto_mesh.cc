// From a scan of an object and its 3D model to a textured model: where on the mesh was the scan, what does it feel
// like there, and which triangles get which texture coordinates.
//
//   04_scan_onto_mesh FOLDER [MESH.svg PROFILE.svg]
//
// FOLDER gets scene.json with the augmented mesh and the texture. The two drawings show the textured triangles and
// the measured over the true profile.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>

#include "asperity/base/output.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/registration/pose_error.h"
#include "asperity/scene/write_scene.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/simulate_recording.h"
#include "mesh_plot.h"
#include "profile_plot.h"

namespace {

// What a probe and a tracker would have recorded: a stroke of 100 mm over a pebble of sandpaper.
asperity::Recording record(const asperity::TriangleMesh& mesh) {
  asperity::SimulationConfig config = asperity::make_simulation_config("sandpaper", "open");
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  config.shape.through =
      "-0.034,-0.012,0.0158;-0.02,0.008,0.0243;0,0.016,0.0251;0.02,0.008,0.0243;0.034,-0.012,0.0158";  // in the mesh's
                                                                                                       // frame, m
  return asperity::simulate_recording(config, *asperity::make_surface(config.surface, 1), mesh);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2 && argc != 4) {
    std::fprintf(stderr, "usage: %s FOLDER [MESH.svg PROFILE.svg]\n", argv[0]);
    return 2;
  }
  // With a mesh and a scan of your own: to_metres(read_mesh("rock.obj"), 1e-3) and read_recording("scan").
  const asperity::TriangleMesh mesh = asperity::make_pebble();
  asperity::Scan scan;
  scan.name = "pebble";
  scan.recording = record(mesh);

  // A guess is where one would have placed the mesh by hand; without one the whole mesh is searched.
  const asperity::Pose truth = asperity::true_pose(*scan.recording).value();
  const double off_rad = 5.0 * std::numbers::pi / 180.0;
  const asperity::Pose guess = asperity::random_motion(5e-3, off_rad, {0.0, 0.0, 0.02}, 1) * truth;

  const asperity::RegisterConfig config;
  const asperity::ScansOnMesh result = asperity::register_scans({scan}, mesh, guess, config);
  for (const asperity::Problem& problem : result.problems) std::printf("note: %s\n", problem.message.c_str());
  for (const asperity::UndeterminedMotion& motion : result.placements.front().registration.undetermined) {
    std::printf("undetermined %s\n", motion.description.c_str());
  }

  const asperity::RegisteredScan& on_mesh = result.scans.front();
  const asperity::PoseError error =
      asperity::pose_error(result.placements.front().registration, truth, on_mesh.path.p_mesh_m);
  std::printf("moved        %.2f mm from the truth, expected %.2f\n", 1e3 * error.rms_m, 1e3 * error.sigma_m);
  std::printf("turned       %.2f degrees, expected %.2f\n", error.rotation_rad * 180.0 / std::numbers::pi,
              error.sigma_rad * 180.0 / std::numbers::pi);
  std::printf("textured     %zu triangles along %.1f mm\n", result.coordinates.warps.front().triangles,
              1e3 * (on_mesh.path.s_m.back() - on_mesh.path.s_m.front()));
  if (!on_mesh.process.accuracy || !on_mesh.process.accuracy->profile) return 1;
  const asperity::ProfileComparison& accuracy = *on_mesh.process.accuracy->profile;
  std::printf("correlation  %.3f with the true height along the path\n", accuracy.correlation);

  // The mesh with its coordinates and textures, as `asperity export` and a renderer read it.
  asperity::MeshFile file;
  file.vertices = mesh.vertices_m;
  file.triangles = mesh.triangles;
  const asperity::Scene scene = asperity::make_scene(result, file, 1.0);
  std::filesystem::create_directories(argv[1]);
  asperity::write_scene(std::filesystem::path(argv[1]) / "scene.json", scene);

  if (argc == 4) {
    asperity::write_file(argv[2], asperity::examples::mesh_svg(scene.objects.front(), on_mesh.path));
    asperity::examples::ProfilePlot plot;
    plot.title = "its profile, 25 mm/s";
    plot.shift_m = accuracy.shift_m;
    plot.from_m = 0.04;
    plot.to_m = 0.06;
    const asperity::Profile true_heights = asperity::true_profile(*scan.recording->truth, config.process.profile);
    asperity::write_file(argv[3], asperity::examples::profile_svg(on_mesh.process.profile, true_heights, plot));
  }
  return result.trustworthy ? 0 : 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
