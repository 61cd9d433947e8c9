#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/calibration/calibrate_camera.h"
#include "asperity/calibration/calibrate_tracker_noise.h"
#include "asperity/calibration/find_board.h"
#include "asperity/simulation/board_poses.h"
#include "asperity/simulation/render_board.h"
#include "demo_rig.h"

namespace asperity::app {

namespace fs = std::filesystem;

void calibrate_the_camera(DemoRig& rig, const Observer& observer) {
  constexpr int kImages = 25;  // seed §3.5
  const SimulatedBoard drawn;
  CalibrationBoard board;
  board.columns = drawn.columns;
  board.rows = drawn.rows;
  board.square_m = drawn.square_m;
  BoardRenderer renderer(rig.live.camera, drawn);
  fs::create_directories(rig.folder / "boards");
  std::vector<BoardView> views;
  GrayImage image;
  for (const Pose& T_world_board : board_poses(rig.live.camera, drawn, kImages, 1)) {
    observer.update("camera", static_cast<double>(views.size()) / kImages);
    renderer.render(T_world_board, views.size(), image);
    const std::string name = fmt::format("board_{:02}.pgm", views.size());
    std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
    bytes.append(image.pixels.begin(), image.pixels.end());
    write_file(rig.folder / "boards" / name, bytes);
    if (auto view = find_board(image, board)) {
      view->name = name;
      views.push_back(std::move(*view));
    }
  }
  const CameraFit fit = calibrate_camera(views, image.width, image.height);
  rig.calibration.camera = fit.camera;
  rig.judge("camera", fit.verdict);
  const CameraVector truth = camera_parameters(camera_truth(rig.live.camera));
  const CameraVector found = camera_parameters(fit.camera);
  constexpr const char* kUnits[] = {"px", "px", "px", "px", "", "", "", "", ""};
  std::vector<DemoMetric> metrics;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    metrics.push_back({kCameraParameterNames[i].data(), kCameraParameterNames[i].data(), kUnits[i], 1.0, found[k],
                       fit.standard_error[k], DemoMetric::kNone, truth[k]});
  }
  rig.add("camera", fmt::format("camera: {} images of a checkerboard", views.size()), metrics);
}

void measure_the_trackers_noise(DemoRig& rig, const Observer& observer) {
  constexpr double kRest_s = 6.0;
  constexpr double kRate_Hz = 40.0;
  const Pose T_world_marker{exp_rotation({0.2, 0.1, 0.05}), {0.0, -0.03, 0.32}};
  const Recording rest =
      simulate_motion(rig, static_motion(T_world_marker, rig.tip_in_marker_m()), kRest_s, "rest", observer);
  const TrackerStream poses = track_motion(rig, rest, kRate_Hz, 1, observer);
  const TrackerStream others = track_motion(rig, rest, kRate_Hz, 2, observer);
  const auto measure = [&](const TrackerStream& stream) {
    const StaticTracker resting{"rest", &stream, rig.calibration.markers, true};
    return calibrate_tracker_noise({&resting, 1});
  };
  const TrackerNoise noise = measure(poses);
  const TrackerNoise other = measure(others);
  rig.calibration.tracker.sigma_position_m = noise.sigma_position_m;
  rig.calibration.tracker.sigma_rotation_rad = noise.sigma_rotation_rad;
  rig.judge("tracker", noise.verdict);
  std::vector<DemoMetric> metrics;
  constexpr const char* kKeys[] = {"sigma_x_m", "sigma_y_m", "sigma_z_m"};
  constexpr const char* kTitles[] = {"noise x", "noise y", "noise z"};
  constexpr const char* kTurnKeys[] = {"sigma_rx_rad", "sigma_ry_rad", "sigma_rz_rad"};
  constexpr const char* kTurnTitles[] = {"noise about x", "noise about y", "noise about z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kKeys[axis], kTitles[axis], "µm", 1e6, noise.sigma_position_m[axis],
                       noise.sigma_position_error_m[axis], DemoMetric::kNone, other.sigma_position_m[axis]});
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kTurnKeys[axis], kTurnTitles[axis], "mrad", 1e3, noise.sigma_rotation_rad[axis],
                       noise.sigma_rotation_error_rad[axis], DemoMetric::kNone, other.sigma_rotation_rad[axis]});
  }
  rig.add("tracker", fmt::format("stationary tracker: {} poses (true: as many others)", poses.size()), metrics);
}

}  // namespace asperity::app
