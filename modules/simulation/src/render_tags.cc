#include "asperity/simulation/render_tags.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "camera_view.h"
#include "printed_figure.h"

namespace asperity {

struct TagRenderer::Impl {
  Impl(const SimulatedCameraConfig& config, const std::vector<MarkerPlacement>& tags)
      : view(config), figures(print_tags(tags)) {}

  void draw(const Pose& T_world_marker_open, const Pose& T_world_marker_close) {
    // Far to near: of a convex body the faces that are seen hide nothing of each other, but blur lets them overlap.
    order.clear();
    for (std::size_t i = 0; i < figures.size(); ++i)
      order.emplace_back(-(T_world_marker_open * figures[i].T_marker_figure.translation_m).norm(), i);
    std::sort(order.begin(), order.end());
    view.begin();
    for (const auto& [minus_distance, i] : order) {
      const Pose& T_marker_figure = figures[i].T_marker_figure;
      view.draw(figures[i].figure, T_world_marker_open * T_marker_figure, T_world_marker_close * T_marker_figure);
    }
  }

  CameraView view;
  std::vector<PlacedFigure> figures;
  std::vector<std::pair<double, std::size_t>> order;
};

TagRenderer::TagRenderer(const SimulatedCameraConfig& config, const std::vector<MarkerPlacement>& tags)
    : impl_(std::make_unique<Impl>(config, tags)) {}

TagRenderer::~TagRenderer() = default;
TagRenderer::TagRenderer(TagRenderer&&) noexcept = default;
TagRenderer& TagRenderer::operator=(TagRenderer&&) noexcept = default;

void TagRenderer::render(const Pose& T_world_marker_open, const Pose& T_world_marker_close, std::uint64_t frame,
                         GrayImage& image) {
  impl_->draw(T_world_marker_open, T_world_marker_close);
  impl_->view.expose(frame, image);
}

void TagRenderer::render_ideal(const Pose& T_world_marker_open, const Pose& T_world_marker_close, IdealImage& image) {
  impl_->draw(T_world_marker_open, T_world_marker_close);
  impl_->view.ideal(image);
}

}  // namespace asperity
