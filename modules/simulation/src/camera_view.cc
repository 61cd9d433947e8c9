#include "camera_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/recording/camera_model.h"
#include "streams.h"

namespace asperity {
namespace {

constexpr double kLongestPiece_px = 4.0;  // distortion bends it by less than 0.003 px, mostly by far less
constexpr double kSubExposure_px = 0.25;  // motion between two sub-exposures
constexpr int kMostSubExposures = 64;
constexpr int kNormals = 4096;

// Medians of `kNormals` equally likely intervals of the normal distribution, scaled to unit variance.
std::vector<float> normal_quantiles() {
  std::vector<double> q(kNormals);
  double x = -4.0;
  double sum2 = 0.0;
  for (int i = 0; i < kNormals; ++i) {
    const double p = (i + 0.5) / kNormals;
    for (int step = 0; step < 50; ++step) {
      const double miss = 0.5 * std::erfc(-x / std::numbers::sqrt2) - p;
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      const double move = std::clamp(miss / density, -0.5, 0.5);
      x -= move;
      if (std::abs(move) < 1e-12) break;
    }
    q[static_cast<std::size_t>(i)] = x;
    sum2 += x * x;
  }
  std::vector<float> out;
  for (const double value : q) out.push_back(static_cast<float>(value / std::sqrt(sum2 / kNormals)));
  return out;
}

struct Box {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e12);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e12);
  void include(const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

}  // namespace

CameraCalibration camera_truth(const SimulatedCameraConfig& config) {
  return {config.width,
          config.height,
          config.fx_px,
          config.fy_px,
          config.cx_px,
          config.cy_px,
          {config.distortion[0], config.distortion[1], config.distortion[2], config.distortion[3], 0.0},
          std::nullopt};
}

double blur_sigma_px(const SimulatedCameraConfig& config, double distance_m) {
  const double circle_px =
      config.fx_px * config.aperture_m * std::abs(1.0 / distance_m - 1.0 / config.focus_distance_m);
  return std::min(20.0, std::hypot(config.lens_sigma_px, 0.25 * circle_px));
}

CameraView::CameraView(const SimulatedCameraConfig& config) : config_(config), camera_(camera_truth(config)) {
  if (config.exposure_s * config.rate_Hz > 1.0)
    throw Error(fmt::format("camera.exposure_s: {} s is longer than a frame's period of {} s", config.exposure_s,
                            1.0 / config.rate_Hz));
  const double half_diagonal_px = 0.5 * std::hypot(config.width, config.height);
  for (int row = 0; row < config.height; ++row) {
    for (int column = 0; column < config.width; ++column) {
      const double r = std::hypot(column - 0.5 * (config.width - 1), row - 0.5 * (config.height - 1));
      light_.push_back(static_cast<float>(1.0 - config.vignetting * std::pow(r / half_diagonal_px, 2)));
    }
  }
  // Beyond the corners' rays the distortion's polynomial may fold back into the image.
  for (const double x : {0.0, config.width - 1.0}) {
    for (const double y : {0.0, config.height - 1.0}) {
      const auto ray = unproject(camera_, {x, y});
      if (!ray) throw Error("camera.distortion: has no inverse in the image's corners");
      greatest_tangent_ = std::max(greatest_tangent_, 1.3 * ray->head<2>().norm());
    }
  }
  normal_ = normal_quantiles();
  const double counts_per_electron = 255.0 / config.full_well_electrons;
  for (int counts = 0; counts < 256; ++counts)
    noise_sigma_.push_back(
        static_cast<float>(std::hypot(config.read_noise_counts, std::sqrt(counts * counts_per_electron))));
  make_background();
  begin();
}

void CameraView::make_background() {
  const auto size = static_cast<std::size_t>(config_.width) * static_cast<std::size_t>(config_.height);
  background_.assign(size, static_cast<float>(config_.background_counts));
  if (config_.clutter) {
    // A wall lit unevenly, then boards, boxes and stripes of all sizes, turned at random.
    constexpr int kShapes = 140;
    Random random(static_cast<std::uint64_t>(config_.seed), stream(Stream::kBackground));
    const Eigen::Vector2d slope(random.uniform(-40.0, 40.0), random.uniform(-40.0, 40.0));
    for (int row = 0; row < config_.height; ++row) {
      for (int column = 0; column < config_.width; ++column)
        background_[static_cast<std::size_t>(row * config_.width + column)] =
            static_cast<float>(110.0 + slope.x() * column / config_.width + slope.y() * row / config_.height);
    }
    for (int shape = 0; shape < kShapes; ++shape) {
      const Eigen::Vector2d centre(random.uniform(0.0, config_.width), random.uniform(0.0, config_.height));
      const double longest = 0.25 * config_.width * std::pow(random.uniform(), 2) + 4.0;
      const Eigen::Vector2d half = longest * Eigen::Vector2d(1.0, random.uniform(0.06, 1.0));
      const double angle = random.uniform(0.0, std::numbers::pi);
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d across(-along.y(), along.x());
      const auto counts = static_cast<float>(random.uniform(15.0, 225.0));
      const int corners = random.chance(0.3) ? 24 : 4;  // a disc or a rectangle
      const auto corner = [&](int i) -> Eigen::Vector2d {
        const double turn = 2.0 * std::numbers::pi * (i + 0.5) / corners;
        const double radius = corners == 4 ? std::numbers::sqrt2 : 1.0;
        return centre + radius * (half.x() * std::cos(turn) * along + half.y() * std::sin(turn) * across);
      };
      Box box;
      for (int i = 0; i < corners; ++i) box.include(corner(i));
      const int left = static_cast<int>(std::floor(box.low.x())), top = static_cast<int>(std::floor(box.low.y()));
      const int width = static_cast<int>(std::ceil(box.high.x())) + 1 - left;
      const int height = static_cast<int>(std::ceil(box.high.y())) + 1 - top;
      card_.reset(left, top, width, height);
      for (int i = 0; i < corners; ++i) card_.add(corner(i), corner(i + 1), 1.0);
      card_.finish(card_cover_);
      for (int row = std::max(0, top); row < std::min(config_.height, top + height); ++row) {
        for (int column = std::max(0, left); column < std::min(config_.width, left + width); ++column) {
          float& out = background_[static_cast<std::size_t>(row * config_.width + column)];
          out += card_cover_[static_cast<std::size_t>((row - top) * width + column - left)] * (counts - out);
        }
      }
    }
  }
  // The blur takes what lies outside as dark: divide by what it leaves of an even image.
  std::vector<float> even(size, 1.0F);
  const double sigma_px = blur_sigma_px(config_, config_.background_distance_m);
  gaussian_blur(background_, config_.width, config_.height, sigma_px, scratch_);
  gaussian_blur(even, config_.width, config_.height, sigma_px, scratch_);
  for (std::size_t i = 0; i < size; ++i) background_[i] *= light_[i] / even[i];
}

void CameraView::begin() { brightness_ = background_; }

bool CameraView::project_vertices(const PrintedFigure& figure, const Pose& T_camera_figure,
                                  std::vector<Eigen::Vector2d>& at_px) const {
  at_px.clear();
  for (const Eigen::Vector2d& vertex : figure.vertices_m) {
    const Eigen::Vector3d p_camera_m = T_camera_figure * Eigen::Vector3d(vertex.x(), vertex.y(), 0.0);
    if (!(p_camera_m.z() > 0.0) || p_camera_m.head<2>().norm() > greatest_tangent_ * p_camera_m.z()) return false;
    at_px.push_back(*project(camera_, p_camera_m));
  }
  return true;
}

void CameraView::add_sides(CoverageRaster& raster, const PrintedFigure& figure,
                           const std::vector<PrintedFigure::Side>& sides, const Pose& T_camera_figure,
                           const std::vector<Eigen::Vector2d>& at_px, double weight) const {
  for (const PrintedFigure::Side& side : sides) {
    const auto a = static_cast<std::size_t>(side.from);
    const auto b = static_cast<std::size_t>(side.to);
    const int pieces = std::max(1, static_cast<int>(std::ceil((at_px[b] - at_px[a]).norm() / kLongestPiece_px)));
    Eigen::Vector2d from = at_px[a];
    for (int piece = 1; piece <= pieces; ++piece) {
      Eigen::Vector2d to = at_px[b];
      if (piece < pieces) {
        const Eigen::Vector2d p =
            figure.vertices_m[a] + static_cast<double>(piece) / pieces * (figure.vertices_m[b] - figure.vertices_m[a]);
        to = *project(camera_, T_camera_figure * Eigen::Vector3d(p.x(), p.y(), 0.0));
      }
      raster.add(from, to, weight);
      from = to;
    }
  }
}

void CameraView::draw(const PrintedFigure& figure, const Pose& T_camera_figure_open,
                      const Pose& T_camera_figure_close) {
  const Pose middle{slerp(T_camera_figure_open.rotation, T_camera_figure_close.rotation, 0.5),
                    lerp(T_camera_figure_open.translation_m, T_camera_figure_close.translation_m, 0.5)};
  const Eigen::Vector3d centre_m = middle * Eigen::Vector3d(figure.centre_m.x(), figure.centre_m.y(), 0.0);
  const double facing = (middle.rotation * Eigen::Vector3d::UnitZ()).dot(centre_m.normalized());
  if (!(facing > 0.0) || !(centre_m.z() > 0.0)) return;

  at_px_.resize(std::max<std::size_t>(at_px_.size(), 2));
  if (!project_vertices(figure, T_camera_figure_open, at_px_[0])) return;
  if (!project_vertices(figure, T_camera_figure_close, at_px_[1])) return;
  double motion_px = 0.0;
  for (std::size_t i = 0; i < at_px_[0].size(); ++i)
    motion_px = std::max(motion_px, (at_px_[1][i] - at_px_[0][i]).norm());
  const int subs = std::clamp(static_cast<int>(std::ceil(motion_px / kSubExposure_px)), 1, kMostSubExposures);
  at_px_.resize(std::max<std::size_t>(at_px_.size(), static_cast<std::size_t>(subs)));
  poses_.clear();
  Box box;
  for (int sub = 0; sub < subs; ++sub) {
    const double share = (sub + 0.5) / subs;
    poses_.push_back({slerp(T_camera_figure_open.rotation, T_camera_figure_close.rotation, share),
                      lerp(T_camera_figure_open.translation_m, T_camera_figure_close.translation_m, share)});
    std::vector<Eigen::Vector2d>& at_px = at_px_[static_cast<std::size_t>(sub)];
    if (!project_vertices(figure, poses_.back(), at_px)) return;
    for (const PrintedFigure::Side& side : figure.card) box.include(at_px[static_cast<std::size_t>(side.from)]);
  }

  const double sigma_px = blur_sigma_px(config_, centre_m.norm());
  // A piece that crosses the window's left border must lie outside of the image and of the blur's reach.
  const int margin = gaussian_reach_px(sigma_px) + static_cast<int>(kLongestPiece_px) + 2;
  const int left = std::max(-margin, static_cast<int>(std::floor(std::max(box.low.x(), -1e6))) - margin);
  const int top = std::max(-margin, static_cast<int>(std::floor(std::max(box.low.y(), -1e6))) - margin);
  const int right = std::min(config_.width + margin, static_cast<int>(std::ceil(std::min(box.high.x(), 1e6))) + margin);
  const int bottom =
      std::min(config_.height + margin, static_cast<int>(std::ceil(std::min(box.high.y(), 1e6))) + margin);
  if (left >= right || top >= bottom) return;
  const int width = right - left;
  const int height = bottom - top;
  ink_.reset(left, top, width, height);
  card_.reset(left, top, width, height);
  for (int sub = 0; sub < subs; ++sub) {
    const auto i = static_cast<std::size_t>(sub);
    add_sides(ink_, figure, figure.ink, poses_[i], at_px_[i], 1.0 / subs);
    add_sides(card_, figure, figure.card, poses_[i], at_px_[i], 1.0 / subs);
  }
  ink_.finish(ink_cover_);
  card_.finish(card_cover_);
  gaussian_blur(ink_cover_, width, height, sigma_px, scratch_);
  gaussian_blur(card_cover_, width, height, sigma_px, scratch_);

  // Lambert's law for a lamp beside the camera, and light from all around.
  const double shade = 0.4 + 0.6 * facing;
  const auto paper = static_cast<float>(shade * config_.paper_counts);
  const auto darkening = static_cast<float>(shade * (config_.paper_counts - config_.ink_counts));
  for (int row = std::max(0, top); row < std::min(config_.height, bottom); ++row) {
    const int first = std::max(0, left);
    const int end = std::min(config_.width, right);
    const auto image_row = static_cast<std::size_t>(row) * static_cast<std::size_t>(config_.width);
    float* const out = brightness_.data() + image_row;
    const float* const light = light_.data() + image_row;
    const auto window_row = static_cast<std::size_t>(row - top) * static_cast<std::size_t>(width);
    const float* const ink = ink_cover_.data() + window_row;
    const float* const card = card_cover_.data() + window_row;
    for (int column = first; column < end; ++column) {
      const int i = column - left;
      out[column] = (1.0F - card[i]) * out[column] + light[column] * (paper * card[i] - darkening * ink[i]);
    }
  }
}

void CameraView::expose(std::uint64_t frame, GrayImage& image) {
  image.width = config_.width;
  image.height = config_.height;
  image.pixels.resize(brightness_.size());
  Random random(static_cast<std::uint64_t>(config_.seed), stream(Stream::kCameraNoise) + (frame << 8U));
  constexpr int kBitsPerPixel = 12;
  static_assert(1 << kBitsPerPixel == kNormals);
  constexpr std::size_t kPixelsPerDraw = 5;
  std::size_t i = 0;
  while (i < brightness_.size()) {
    std::uint64_t bits = random.bits();
    const std::size_t end = std::min(brightness_.size(), i + kPixelsPerDraw);
    for (; i < end; ++i, bits >>= kBitsPerPixel) {
      const float counts = std::clamp(brightness_[i], 0.0F, 255.0F);
      const float noisy = counts + noise_sigma_[static_cast<std::size_t>(counts)] * normal_[bits & (kNormals - 1U)];
      image.pixels[i] = static_cast<std::uint8_t>(std::clamp(noisy + 0.5F, 0.0F, 255.0F));
    }
  }
}

void CameraView::ideal(IdealImage& image) const {
  image.width = config_.width;
  image.height = config_.height;
  image.counts = brightness_;
}

}  // namespace asperity
