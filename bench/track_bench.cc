// Speed and accuracy of the tracker on drawn images, beside OpenCV's ArUco and a pose of each tag by itself.
//   track_bench [frames a distance] [first seed] [table]   table: errors and sigma alone, in Markdown, no speeds

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <time.h>

#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "../tests/tracking/tag_scene.h"
#include "asperity/base/random.h"
#include "asperity/tracking/track_body.h"

namespace {

using namespace asperity;

// Of this thread on its core, so that other programs don't count.
double now_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Errors {
  std::vector<double> mm, degrees, mahalanobis2, sigma_mm, sigma_degrees;
  double seconds = 0.0;
  int frames = 0;

  void add(const Pose& found, const Pose& truth) {
    mm.push_back((found.translation_m - truth.translation_m).norm() * 1e3);
    degrees.push_back(log_rotation(found.rotation * truth.rotation.conjugate()).norm() * 180.0 / std::numbers::pi);
  }
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

void print_row(const char* name, const Errors& e) {
  std::printf("  %-34s %4zu/%-4d %8.4f %8.4f   %8.4f %8.4f  %8.1f", name, e.mm.size(), e.frames, quantile(e.mm, 0.5),
              quantile(e.mm, 0.95), quantile(e.degrees, 0.5), quantile(e.degrees, 0.95),
              e.frames / std::max(1e-9, e.seconds));
  if (!e.mahalanobis2.empty()) {
    double mean = 0.0;
    for (const double d : e.mahalanobis2) mean += d / static_cast<double>(e.mahalanobis2.size());
    std::printf("   chi2 %6.2f (6) median %5.2f (5.35), sigma %.4f mm", mean, quantile(e.mahalanobis2, 0.5),
                quantile(e.sigma_mm, 0.5));
  }
  std::printf("\n");
}

double rms(const std::vector<double>& values) {
  double square = 0.0;
  for (const double v : values) square += v * v;
  return std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

// A row of the table: errors, σ and error over σ by RMS, and the squared Mahalanobis distance, whose mean is 6 when σ
// is right.
void print_table_row(const char* body, double distance_m, const Errors& e) {
  std::printf("| %s | %.2f | %zu of %d | %.4f, %.4f | %.4f, %.4f | %.4f | %.2f | %.4f | %.2f | %.1f |\n", body,
              distance_m, e.mm.size(), e.frames, quantile(e.mm, 0.5), quantile(e.mm, 0.95), quantile(e.degrees, 0.5),
              quantile(e.degrees, 0.95), quantile(e.sigma_mm, 0.5), rms(e.mm) / rms(e.sigma_mm),
              quantile(e.sigma_degrees, 0.5), rms(e.degrees) / rms(e.sigma_degrees), quantile(e.mahalanobis2, 0.5));
}

using Solver = std::function<std::optional<Pose>(const GrayImage&)>;

// The body's pose from the tag that is seen largest.
std::optional<Pose> pose_of_largest(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                    const std::vector<TagDetection>& tags) {
  cv::Mat K = (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::optional<Pose> out;
  double largest = 0.0;
  for (const TagDetection& tag : tags) {
    for (const MarkerPlacement& marker : body) {
      if (marker.id != tag.id) continue;
      const double size = (tag.corners_px.col(0) - tag.corners_px.col(2)).norm();
      if (size <= largest) continue;
      const double h = marker.size_m / 2;
      std::vector<cv::Point3d> square{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
      std::vector<cv::Point2d> seen;
      for (int i = 0; i < 4; ++i) seen.emplace_back(tag.corners_px(0, i), tag.corners_px(1, i));
      cv::Vec3d r, t;
      if (!cv::solvePnP(square, seen, K, camera.distortion, r, t, false, cv::SOLVEPNP_IPPE_SQUARE)) continue;
      largest = size;
      const Pose T_camera_up{exp_rotation(Eigen::Vector3d(r[0], r[1], r[2])), {t[0], t[1], t[2]}};
      out = T_camera_up * Pose{Eigen::Quaterniond(0, 1, 0, 0), Eigen::Vector3d::Zero()} * marker.T_marker_tag.inverse();
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const int frames = argc > 1 ? std::atoi(argv[1]) : 60;
  const std::uint64_t first_seed = argc > 2 ? static_cast<std::uint64_t>(std::atoll(argv[2])) : 1;
  const bool table = argc > 3 && std::string_view(argv[3]) == "table";
  if (table) {
    std::printf(
        "| body | distance, m | found | error, mm: median, 95 %% | degrees: median, 95 %% | sigma, mm | error / sigma "
        "| sigma, degrees | error / sigma | chi2, median (5.35) |\n|---|---|---|---|---|---|---|---|---|---|\n");
  }
  const CameraCalibration camera = test_camera();
  for (const bool flat : {true, false}) {
    const std::vector<MarkerPlacement> body = flat ? flat_pair() : sleeve();
    const char* const body_name = flat ? "two tags in a plane" : "three tags on a sleeve";
    if (!table) {
      std::printf("%s, 640x480, noise 2.5, defocus 0.6 px, clutter\n", body_name);
      std::printf("  %-34s %9s %17s   %17s  %8s\n", "", "found", "mm 50 %, 95 %", "degrees", "frames/s");
    }
    for (const double distance_m : {0.25, 0.4, 0.6}) {
      // A smooth motion, so that tracking is tracking.
      std::vector<GrayImage> images;
      std::vector<Pose> truths;
      TagScene scene;
      scene.camera = camera;
      scene.body = body;
      std::vector<Pose> keys;
      for (int k = 0; k < 1 + frames / 10 + 1; ++k)
        keys.push_back(random_view(distance_m, flat ? 0.7 : 0.5, first_seed * 1000 + static_cast<std::uint64_t>(k)));
      for (int i = 0; i < frames; ++i) {
        const double at = i / 10.0;
        const auto k = static_cast<std::size_t>(at);
        const double part = 0.5 - 0.5 * std::cos(std::numbers::pi * (at - static_cast<double>(k)));
        truths.push_back({slerp(keys[k].rotation, keys[k + 1].rotation, part),
                          lerp(keys[k].translation_m, keys[k + 1].translation_m, part)});
        images.push_back(draw(scene, truths.back(), first_seed * 7919 + static_cast<std::uint64_t>(i)));
      }
      if (!table) std::printf(" %.2f m\n", distance_m);
      for (const bool refine : {true, false}) {
        if (table && !refine) continue;
        TrackConfig config;
        config.refine.enabled = refine;
        BodyTracker tracker(camera, body, config);
        Errors errors;
        for (std::size_t i = 0; i < images.size(); ++i) {
          const double start = now_s();
          auto pose = tracker.push(images[i], static_cast<std::int64_t>(i) * 10'000'000);
          errors.seconds += now_s() - start;
          ++errors.frames;
          if (!pose) continue;
          const Pose& found = pose->sample.T_world_marker;
          errors.add(found, truths[i]);
          // Board and camera are right here: what remains is the part of the error that is of this frame alone.
          Eigen::Matrix<double, 6, 1> e;
          e << found.translation_m - truths[i].translation_m,
              log_rotation(found.rotation * truths[i].rotation.conjugate());
          errors.mahalanobis2.push_back(e.dot(pose->noise.ldlt().solve(e)));
          errors.sigma_degrees.push_back(std::sqrt(pose->noise.bottomRightCorner<3, 3>().trace()) * 180.0 /
                                         std::numbers::pi);
          errors.sigma_mm.push_back(std::sqrt(pose->noise.topLeftCorner<3, 3>().trace()) * 1e3);
        }
        if (table) {
          print_table_row(body_name, distance_m, errors);
        } else {
          print_row(refine ? "ours" : "ours on AprilTag's corners", errors);
        }
      }
      if (table) continue;
      const auto run = [&](const char* name, const Solver& solver) {
        Errors errors;
        for (std::size_t i = 0; i < images.size(); ++i) {
          const double start = now_s();
          const auto pose = solver(images[i]);
          errors.seconds += now_s() - start;
          ++errors.frames;
          if (pose) errors.add(*pose, truths[i]);
        }
        print_row(name, errors);
      };
      const std::unique_ptr<TagDetector> detector = make_tag_detector("tag36h11");
      run("one tag, AprilTag + IPPE_SQUARE", [&](const GrayImage& image) {
        std::vector<TagDetection> tags;
        detector->detect(image, whole(image), tags);
        return pose_of_largest(camera, body, tags);
      });
      auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
      for (const bool subpixel : {false, true}) {
        auto parameters = cv::aruco::DetectorParameters::create();
        parameters->cornerRefinementMethod = subpixel ? cv::aruco::CORNER_REFINE_SUBPIX : cv::aruco::CORNER_REFINE_NONE;
        run(subpixel ? "one tag, ArUco sub-pixel + IPPE" : "one tag, ArUco + IPPE_SQUARE", [&](const GrayImage& image) {
          const cv::Mat view(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
          std::vector<std::vector<cv::Point2f>> corners;
          std::vector<int> ids;
          cv::aruco::detectMarkers(view, dictionary, corners, ids, parameters);
          std::vector<TagDetection> tags;
          for (std::size_t i = 0; i < ids.size(); ++i) {
            TagDetection tag;
            tag.id = ids[i];
            // OpenCV's picture of this family is turned by half a turn.
            for (int c = 0; c < 4; ++c)
              tag.corners_px.col(c) = Eigen::Vector2d(corners[i][static_cast<std::size_t>((c + 2) % 4)].x,
                                                      corners[i][static_cast<std::size_t>((c + 2) % 4)].y);
            tags.push_back(tag);
          }
          return pose_of_largest(camera, body, tags);
        });
      }
    }
  }
  return 0;
}
