#include "mesh_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/texture/evaluate_height.h"

namespace asperity::examples {
namespace {

using Eigen::Vector3d;

constexpr double kWidth_px = 900.0, kHeight_px = 460.0, kMargin_px = 14.0, kLegend_px = 44.0;
constexpr double kCloseSize_px = 340.0, kMagnification = 5.0;
const Eigen::Vector2d kClose_px(546.0, 82.0);  // the close-up's upper left corner
constexpr int kGreys = 24, kColours = 15, kCuts = 4;

// Right, up and towards the eye, mesh frame.
struct View {
  Eigen::Matrix3d axes;  // rows
  Vector3d low_m, high_m;
  double px_per_m = 1.0;

  Eigen::Vector2d px(const Vector3d& p_m) const {
    const Vector3d q = axes * p_m;
    const double left = kMargin_px;
    const double top = kLegend_px + 0.5 * (kHeight_px - kLegend_px - px_per_m * (high_m.y() - low_m.y()));
    return {left + px_per_m * (q.x() - low_m.x()), top + px_per_m * (high_m.y() - q.y())};
  }
};

View make_view(const TriangleMesh& mesh, const MeshPath& path) {
  Vector3d outward = Vector3d::Zero();
  for (const std::uint32_t triangle : path.triangle) {
    const Triangle& t = mesh.triangles[triangle];
    const Vector3d &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]], &c = mesh.vertices_m[t[2]];
    outward += (b - a).cross(c - a).normalized();
  }
  View view;
  const Vector3d towards = outward.normalized();
  const Vector3d chord = path.p_mesh_m.back() - path.p_mesh_m.front();
  const Vector3d right = (chord - chord.dot(towards) * towards).normalized();
  view.axes << right.transpose(), towards.cross(right).transpose(), towards.transpose();
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices_m) box.extend(view.axes * p);
  view.low_m = box.min();
  view.high_m = box.max();
  view.px_per_m = std::min((kClose_px.x() - 2.0 * kMargin_px) / box.sizes().x(),
                           (kHeight_px - kLegend_px - 2.0 * kMargin_px) / box.sizes().y());
  return view;
}

// Tenths of pixels, the second and third corner relative: half the bytes.
void add_triangle(const std::array<Eigen::Vector2d, 3>& corners_px, std::string& to) {
  std::array<Eigen::Vector2i, 3> at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = (10.0 * corners_px[k]).array().round().cast<int>();
  const Eigen::Vector2i ab = at[1] - at[0], bc = at[2] - at[1];
  to += fmt::format("M{} {}l{} {} {} {}z", at[0].x(), at[0].y(), ab.x(), ab.y(), bc.x(), bc.y());
}

// From blue through pale to red.
std::string height_colour(int step) {
  const double u = 2.0 * step / (kColours - 1) - 1.0;
  const Vector3d low(33, 84, 158), middle(244, 238, 226), high(176, 42, 40);
  const Vector3d c = u < 0.0 ? middle + std::abs(u) * (low - middle) : middle + u * (high - middle);
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(c[0]), std::lround(c[1]), std::lround(c[2]));
}

std::string grey(int step) {
  const double share = static_cast<double>(step) / (kGreys - 1);
  const int v = static_cast<int>(std::lround(96.0 + 150.0 * share));
  return fmt::format("#{0:02x}{0:02x}{1:02x}", v, std::max(0, v - 6));
}

struct Layers {
  std::map<int, std::string> stone, texture;  // paths by shade
  std::string edges;                          // of the textured triangles
};

// The textured triangle cut into kCuts² pieces, each in the colour of its middle.
void add_textured(const std::array<Vector3d, 3>& p_m, const HapticTriangle& haptic, const TextureModel& model,
                  double range_m, const View& view, Layers& layers) {
  for (int i = 0; i < kCuts; ++i) {
    for (int j = 0; i + j < kCuts; ++j) {
      for (const bool upper : {false, true}) {
        if (upper && i + j + 1 >= kCuts) continue;
        const std::array<Eigen::Vector2d, 3> ij =
            upper ? std::array<Eigen::Vector2d, 3>{{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}}
                  : std::array<Eigen::Vector2d, 3>{{{i, j}, {i + 1, j}, {i, j + 1}}};
        std::array<Eigen::Vector2d, 3> corners_px;
        Eigen::Vector2d xy_mm = Eigen::Vector2d::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
          const double u = ij[k].x() / kCuts, v = ij[k].y() / kCuts;
          corners_px[k] = view.px((1.0 - u - v) * p_m[0] + u * p_m[1] + v * p_m[2]);
          xy_mm += ((1.0 - u - v) * haptic.xy_mm[0] + u * haptic.xy_mm[1] + v * haptic.xy_mm[2]) / 3.0;
        }
        const double height_m = evaluate_height(model, 1e-3 * xy_mm.x(), 1e-3 * xy_mm.y()).height_m;
        const double share = std::clamp(0.5 + 0.5 * height_m / range_m, 0.0, 1.0);
        add_triangle(corners_px, layers.texture[static_cast<int>(std::lround(share * (kColours - 1)))]);
      }
    }
  }
}

std::string path_line(const MeshPath& path, const View& view) {
  std::string out;
  for (std::size_t i = 0; i < path.size(); i += 4) {
    const Eigen::Vector2d at = 10.0 * view.px(path.p_mesh_m[i]);
    out += fmt::format("{}{:.0f} {:.0f}", i == 0 ? "M" : "L", at.x(), at.y());
  }
  return out;
}

// The drawing again, larger, about a place that a frame marks.
std::string close_up(const Eigen::Vector2d& at_px) {
  const double part_px = kCloseSize_px / kMagnification;
  const Eigen::Vector2d shift_px = kClose_px + Eigen::Vector2d::Constant(0.5 * kCloseSize_px) - kMagnification * at_px;
  return fmt::format(
             "<clipPath id=\"frame\"><rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\"/></clipPath>\n"
             "<g clip-path=\"url(#frame)\"><use href=\"#mesh\" transform=\"translate({3:.1f} {4:.1f}) "
             "scale({5})\"/></g>\n",
             kClose_px.x(), kClose_px.y(), kCloseSize_px, shift_px.x(), shift_px.y(), kMagnification) +
         fmt::format(
             "<g fill=\"none\" stroke=\"#111\"><rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\"/><rect "
             "x=\"{3:.1f}\" y=\"{4:.1f}\" width=\"{5}\" height=\"{5}\"/></g>\n",
             kClose_px.x(), kClose_px.y(), kCloseSize_px, at_px.x() - 0.5 * part_px, at_px.y() - 0.5 * part_px,
             part_px);
}

std::string legend(double range_m) {
  std::string out = fmt::format(
      "<g fill=\"#333\"><text x=\"{:.0f}\" y=\"28\" font-weight=\"bold\" fill=\"#111\">a scan on its mesh</text>"
      "<path d=\"M430 23H460\" stroke=\"#111\" stroke-width=\"1.6\"/><text x=\"468\" y=\"28\">scan path</text>"
      "<text x=\"560\" y=\"28\">texture, µm</text><text x=\"652\" y=\"28\">−{:.0f}</text><text x=\"846\" "
      "y=\"28\">{:.0f}</text>",
      72.0, 1e6 * range_m, 1e6 * range_m);
  for (int step = 0; step < kColours; ++step) {
    out += fmt::format("<rect x=\"{}\" y=\"16\" width=\"10.5\" height=\"14\" fill=\"{}\"/>", 688 + 10 * step,
                       height_colour(step));
  }
  return out + "</g>\n";
}

}  // namespace

std::string mesh_svg(const SceneObject& object, const MeshPath& path) {
  const TriangleMesh mesh = to_metres(object.mesh, object.unit_m);
  const View view = make_view(mesh, path);
  const Vector3d light = Vector3d(-0.4, 0.65, 0.65).normalized();
  constexpr double kRange_m = 80e-6;
  Layers layers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vector3d, 3> p_m;
    for (std::size_t k = 0; k < 3; ++k) p_m[k] = mesh.vertices_m[mesh.triangles[t][k]];
    const Vector3d normal = view.axes * (p_m[1] - p_m[0]).cross(p_m[2] - p_m[0]).normalized();
    if (!(normal.z() > 0.0)) continue;
    const SceneTexture* texture =
        object.mesh.haptic.empty() ? nullptr : object.find_texture(object.mesh.haptic[t].texture);
    if (texture != nullptr && is_height_field(texture->texture.model)) {
      add_triangle({view.px(p_m[0]), view.px(p_m[1]), view.px(p_m[2])}, layers.edges);
      add_textured(p_m, object.mesh.haptic[t], texture->texture.model, kRange_m, view, layers);
      continue;
    }
    const double shade = std::clamp(0.25 + 0.75 * normal.dot(light), 0.0, 1.0);
    add_triangle({view.px(p_m[0]), view.px(p_m[1]), view.px(p_m[2])},
                 layers.stone[static_cast<int>(std::lround(shade * (kGreys - 1)))]);
  }
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n"
      "<g id=\"mesh\"><g transform=\"scale(0.1)\" stroke-width=\"5\" stroke-linejoin=\"round\">\n",
      kWidth_px, kHeight_px);
  for (const auto& [step, paths] : layers.stone) {
    out += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", grey(step), paths);
  }
  for (const auto& [step, paths] : layers.texture) {
    out += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", height_colour(step), paths);
  }
  out += fmt::format("<path fill=\"none\" stroke=\"#333\" stroke-width=\"2\" d=\"{}\"/>\n", layers.edges);
  out += fmt::format("<path fill=\"none\" stroke=\"#111\" stroke-width=\"11\" d=\"{}\"/>\n</g></g>\n",
                     path_line(path, view));
  return out + close_up(view.px(path.p_mesh_m[path.size() / 3])) + legend(kRange_m) + "</svg>\n";
}

}  // namespace asperity::examples
