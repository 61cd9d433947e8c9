// The height-map viewer through the whole servo step: Basdogan's force on every tile, none between.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/render/render_step.h"
#include "asperity/scene/height_map_viewer.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

Texture waves(double pitch_px) {
  HeightMap map{64, 64, 10.0 / 64, 10.0 / 64, 0.0, 0.5e-3, 16, Border::kMirror, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const double h = 0.5 + 0.25 * std::sin(i % 64 / pitch_px) + 0.2 * std::cos(i / 64 / (2.0 * pitch_px));
    map.level.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * h)));
  }
  Texture texture;
  texture.model = map;
  return texture;
}

// The texture's force after the tip came down from 3 mm above to 0.3 mm below the plane.
ServoOutput lowered(const RenderModel& model, double x_m, double y_m) {
  ServoState state;
  ServoOutput output;
  for (int i = 0; i <= 600; ++i) {
    DeviceState device;
    device.p_world_m = Eigen::Vector3d(x_m, y_m, 3e-3 - 3.3e-3 * std::min(i, 500) / 500.0);
    output = render_step(model, state, device);
  }
  return output;
}

TEST(HeightMapViewer, IsFeltAsBasdogansForce) {
  const std::vector<Texture> tiles{waves(2.0), waves(3.0), waves(4.0), waves(5.0)};
  RenderConfig config;
  config.texture.model = TextureForceModel::kNormalPerturbation;
  const RenderModel model = make_render_model(make_height_map_viewer(tiles), config);
  const Eigen::Vector2d corners_mm[] = {{2.0, 14.0}, {14.0, 14.0}, {2.0, 2.0}, {14.0, 2.0}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (const auto& [x_mm, y_mm] : {std::pair{5.03, 4.98}, {3.3, 6.1}, {7.2, 2.9}}) {
      const ServoOutput output =
          lowered(model, 1e-3 * (corners_mm[k].x() + x_mm), 1e-3 * (corners_mm[k].y() + 10.0 - y_mm));
      const HeightAndGradient h = evaluate_height(tiles[k].model, 1e-3 * x_mm, 1e-3 * y_mm);
      const double height_m = h.height_m + height_offset_m(tiles[k].model);
      // The image's y runs down the plane.
      const Eigen::Vector3d m = Eigen::Vector3d(-h.slope_x, h.slope_y, 1.0).normalized();
      EXPECT_NEAR((output.texture_N - 400.0 * height_m * m).norm(), 0.0, 1e-6) << k << ' ' << x_mm;
      EXPECT_NEAR((output.contact_N - Eigen::Vector3d(0.0, 0.0, 400.0 * 0.3e-3)).norm(), 0.0, 1e-6);
      EXPECT_NEAR(output.texture_height_m, height_m, 1e-9);
    }
  }
  EXPECT_EQ(lowered(model, 13e-3, 7e-3).texture_N, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace asperity
