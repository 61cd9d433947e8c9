#include "tag_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>

#include <apriltag.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagStandard41h12.h>

#include "asperity/base/random.h"
#include "asperity/recording/camera_model.h"

namespace asperity {
namespace {

struct Picture {
  int cells = 0, border = 0;
  std::vector<bool> white;
};

const Picture& picture(const std::string& family, int id) {
  static std::map<std::pair<std::string, int>, Picture> drawn;
  Picture& out = drawn[{family, id}];
  if (out.cells > 0) return out;
  apriltag_family_t* f = family == "tag36h11"  ? tag36h11_create()
                         : family == "tag25h9" ? tag25h9_create()
                         : family == "tag16h5" ? tag16h5_create()
                                               : tagStandard41h12_create();
  image_u8_t* image = apriltag_to_image(f, id);
  out.cells = f->total_width;
  out.border = f->width_at_border;
  for (int row = 0; row < out.cells; ++row) {
    for (int column = 0; column < out.cells; ++column)
      out.white.push_back(image->buf[row * image->stride + column] > 0);
  }
  // Debian's library does not export its own function for this.
  std::free(image->buf);
  std::free(image);
  return out;
}

// Grey levels, row by row.
struct Plane {
  int width, height;
  std::vector<float> grey;
  float& at(int x, int y) {
    return grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

void blur(Plane& plane, double sigma) {
  if (sigma <= 0.0) return;
  const int reach = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  for (int i = -reach; i <= reach; ++i)
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)) / sum));
  for (const bool along_x : {true, false}) {
    Plane out{plane.width, plane.height, std::vector<float>(plane.grey.size(), 0.0f)};
    for (int y = 0; y < plane.height; ++y) {
      for (int i = -reach; i <= reach; ++i) {
        const float k = kernel[static_cast<std::size_t>(i + reach)];
        if (along_x) {
          for (int x = 0; x < plane.width; ++x) out.at(x, y) += k * plane.at(std::clamp(x + i, 0, plane.width - 1), y);
        } else {
          const int from = std::clamp(y + i, 0, plane.height - 1);
          for (int x = 0; x < plane.width; ++x) out.at(x, y) += k * plane.at(x, from);
        }
      }
    }
    plane = std::move(out);
  }
}

Plane background(const TagScene& scene, std::uint64_t seed) {
  Plane out{scene.camera.width, scene.camera.height, {}};
  out.grey.assign(static_cast<std::size_t>(out.width * out.height), 110.0f);
  if (!scene.clutter) return out;
  Random random(seed, 7);
  for (int i = 0; i < 150; ++i) {
    const int x0 = static_cast<int>(random.uniform(-40, out.width)),
              y0 = static_cast<int>(random.uniform(-40, out.height));
    const int w = static_cast<int>(random.uniform(4, 110)), h = static_cast<int>(random.uniform(4, 110));
    const float grey = static_cast<float>(random.uniform(15, 240));
    const double slant = random.uniform(-1.0, 1.0);
    for (int y = std::max(0, y0); y < std::min(out.height, y0 + h); ++y) {
      const int shift = static_cast<int>(slant * (y - y0));
      for (int x = std::max(0, x0 + shift); x < std::min(out.width, x0 + w + shift); ++x) out.at(x, y) = grey;
    }
  }
  return out;
}

}  // namespace

GrayImage draw(const TagScene& scene, const Pose& T_camera_marker, std::uint64_t seed, const std::vector<Blob>& blobs) {
  const CameraCalibration& camera = scene.camera;
  Plane image = background(scene, seed);
  // The part that the tags may cover.
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const MarkerPlacement& marker : scene.body) {
    const Picture& tag = picture(marker.family, marker.id);
    const double half_m = 0.5 * marker.size_m * tag.cells / tag.border;
    for (const double x : {-half_m, half_m}) {
      for (const double y : {-half_m, half_m}) {
        const auto pixel = project(camera, T_camera_marker * (marker.T_marker_tag * Eigen::Vector3d(x, y, 0.0)));
        if (!pixel) continue;
        left = std::min(left, pixel->x()), right = std::max(right, pixel->x());
        top = std::min(top, pixel->y()), bottom = std::max(bottom, pixel->y());
      }
    }
  }
  const double pad = 6.0 + 4.0 * scene.defocus_px;
  const int x0 = std::clamp(static_cast<int>(left - pad), 0, camera.width),
            x1 = std::clamp(static_cast<int>(right + pad) + 1, x0, camera.width);
  const int y0 = std::clamp(static_cast<int>(top - pad), 0, camera.height),
            y1 = std::clamp(static_cast<int>(bottom + pad) + 1, y0, camera.height);
  const int n = scene.rays;
  Plane fine{(x1 - x0) * n, (y1 - y0) * n, {}};
  fine.grey.assign(static_cast<std::size_t>(fine.width) * static_cast<std::size_t>(fine.height), 0.0f);

  const bool moves = scene.motion_m.norm() > 0.0 || scene.turn_rad.norm() > 0.0;
  const int instants = moves ? 9 : 1;
  std::vector<std::vector<Pose>> T_tag_camera(static_cast<std::size_t>(instants));
  for (int k = 0; k < instants; ++k) {
    const double when = moves ? (k + 0.5) / instants - 0.5 : 0.0;
    const Pose pose{exp_rotation(when * scene.turn_rad) * T_camera_marker.rotation,
                    T_camera_marker.translation_m + when * scene.motion_m};
    for (const MarkerPlacement& marker : scene.body)
      T_tag_camera[static_cast<std::size_t>(k)].push_back((pose * marker.T_marker_tag).inverse());
  }
  std::vector<const Picture*> pictures;
  for (const MarkerPlacement& marker : scene.body) pictures.push_back(&picture(marker.family, marker.id));
  for (int fy = 0; fy < fine.height; ++fy) {
    for (int fx = 0; fx < fine.width; ++fx) {
      const Eigen::Vector2d pixel(x0 + (fx + 0.5) / n - 0.5, y0 + (fy + 0.5) / n - 0.5);
      const auto ray = unproject(camera, pixel);
      const float behind = image.at(x0 + fx / n, y0 + fy / n);
      double sum = 0.0;
      for (const std::vector<Pose>& poses : T_tag_camera) {
        double nearest = 1e9, grey = behind;
        for (std::size_t t = 0; t < poses.size(); ++t) {
          const Eigen::Vector3d direction = poses[t].rotation * *ray;
          const Eigen::Vector3d& origin = poses[t].translation_m;
          // Seen from the front only: z points into the tag.
          if (direction.z() <= 0.0) continue;
          const double far = -origin.z() / direction.z();
          if (far <= 0.0 || far >= nearest) continue;
          const Eigen::Vector3d hit = origin + far * direction;
          const Picture& tag = *pictures[t];
          const double cell = scene.body[t].size_m / tag.border;
          const int column = static_cast<int>(std::floor(hit.x() / cell + 0.5 * tag.cells));
          const int row = static_cast<int>(std::floor(hit.y() / cell + 0.5 * tag.cells));
          if (column < 0 || row < 0 || column >= tag.cells || row >= tag.cells) continue;
          nearest = far;
          grey = tag.white[static_cast<std::size_t>(row * tag.cells + column)] ? scene.white : scene.black;
        }
        sum += grey;
      }
      const double light = 1.0 + scene.shade * (pixel.x() / camera.width - 0.5);
      double grey = light * sum / instants;
      for (const Blob& blob : blobs) {
        if ((pixel - blob.centre_px).norm() < blob.radius_px) grey = blob.grey;
      }
      fine.at(fx, fy) = static_cast<float>(grey);
    }
  }
  blur(fine, scene.defocus_px * n);
  blur(image, scene.defocus_px);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      float sum = 0.0f;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) sum += fine.at((x - x0) * n + i, (y - y0) * n + j);
      }
      image.at(x, y) = sum / static_cast<float>(n * n);
    }
  }
  Random random(seed, 11);
  GrayImage out{camera.width, camera.height, {}};
  out.pixels.reserve(image.grey.size());
  for (const float grey : image.grey) {
    out.pixels.push_back(static_cast<std::uint8_t>(
        std::clamp(std::lround(static_cast<double>(grey) + scene.noise * random.normal()), 0L, 255L)));
  }
  return out;
}

CameraCalibration test_camera() {
  CameraCalibration camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 603.0;
  camera.fy = 601.5;
  camera.cx = 322.7;
  camera.cy = 236.1;
  camera.distortion = {-0.24, 0.09, 0.0006, -0.0008, 0.0};
  return camera;
}

std::vector<MarkerPlacement> flat_pair() {
  std::vector<MarkerPlacement> body(2);
  for (int i = 0; i < 2; ++i) {
    MarkerPlacement& tag = body[static_cast<std::size_t>(i)];
    tag.id = 3 + i;
    tag.family = "tag36h11";
    tag.size_m = 0.046;
    tag.T_marker_tag.translation_m = {0.0, i == 0 ? -0.029 : 0.029, 0.0};
  }
  return body;
}

std::vector<MarkerPlacement> sleeve() {
  std::vector<MarkerPlacement> body(3);
  for (int i = 0; i < 3; ++i) {
    MarkerPlacement& tag = body[static_cast<std::size_t>(i)];
    tag.id = 10 + i;
    tag.family = "tag36h11";
    tag.size_m = 0.046;
    // On a sleeve about y, 50 mm from its axis; the middle tag faces −z.
    const Eigen::Quaterniond turn = exp_rotation(Eigen::Vector3d(0.0, (i - 1) * std::numbers::pi / 3.0, 0.0));
    tag.T_marker_tag = {turn, turn * Eigen::Vector3d(0.0, 0.0, -0.0515)};
  }
  return body;
}

Pose random_view(double distance_m, double tilt_rad, std::uint64_t seed) {
  Random random(seed, 3);
  const double about = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double tilt = tilt_rad * std::sqrt(random.uniform());
  const Eigen::Quaterniond away = exp_rotation(tilt * Eigen::Vector3d(std::cos(about), std::sin(about), 0.0));
  const Eigen::Quaterniond roll =
      exp_rotation(Eigen::Vector3d(0.0, 0.0, random.uniform(-std::numbers::pi, std::numbers::pi)));
  const double reach = std::max(0.0, 0.38 - 0.075 / distance_m);
  return {away * roll,
          distance_m * Eigen::Vector3d(random.uniform(-reach, reach), random.uniform(-0.7 * reach, 0.7 * reach), 1.0)};
}

}  // namespace asperity
