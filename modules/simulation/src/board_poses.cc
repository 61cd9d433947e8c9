#include "asperity/simulation/board_poses.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/recording/camera_model.h"
#include "printed_figure.h"
#include "streams.h"

namespace asperity {
namespace {

bool is_whole(const SimulatedCameraConfig& config, const PrintedFigure& figure, const Pose& T_world_board) {
  constexpr double kMargin_px = 3.0;
  const CameraCalibration camera = camera_truth(config);
  for (const PrintedFigure::Side& side : figure.ink) {
    const Eigen::Vector2d& p = figure.vertices_m[static_cast<std::size_t>(side.from)];
    const auto at = project(camera, T_world_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
    if (!at || !(at->array() > kMargin_px).all() || at->x() > config.width - kMargin_px ||
        at->y() > config.height - kMargin_px)
      return false;
  }
  return true;
}

}  // namespace

std::vector<Pose> board_poses(const SimulatedCameraConfig& config, const SimulatedBoard& board, int count,
                              std::uint64_t seed) {
  constexpr double kDegree_rad = std::numbers::pi / 180.0;
  constexpr int kMostTries = 20000;
  const PrintedFigure figure = print_board(board);
  const Eigen::Vector3d centre_m = board_centre_m(board);
  // At this distance the pattern's width fills the image's.
  const double width_m = board.square_m * (board.columns + 1);
  const double near_m = width_m * config.fx_px / config.width;
  const double half_width = 0.5 * config.width / config.fx_px;
  const double half_height = 0.5 * config.height / config.fy_px;
  Random random(seed, stream(Stream::kBoards));
  std::vector<Pose> out;
  for (int tries = 0; static_cast<int>(out.size()) < count; ++tries) {
    if (tries == kMostTries) throw Error("board_poses: the camera does not see this board whole");
    const double tilt_rad = kDegree_rad * random.uniform(10.0, 40.0);
    const double direction_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double roll_rad = random.uniform(-0.3, 0.3);
    const double z_m = near_m * random.uniform(1.0, 1.6);
    const Eigen::Quaterniond q =
        exp_rotation(tilt_rad * Eigen::Vector3d(std::cos(direction_rad), std::sin(direction_rad), 0.0)) *
        exp_rotation({0.0, 0.0, roll_rad});
    // The image's corners, where distortion shows, are sought.
    const auto aside = [&random] { return std::cos(random.uniform(0.0, std::numbers::pi)); };
    const double x_m = z_m * half_width * aside();
    const double y_m = z_m * half_height * aside();
    const Eigen::Vector3d middle_m(x_m, y_m, z_m);
    const Pose T_world_board{q, middle_m - q * centre_m};
    if (is_whole(config, figure, T_world_board)) out.push_back(T_world_board);
  }
  return out;
}

}  // namespace asperity
