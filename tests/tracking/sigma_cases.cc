#include "sigma_cases.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/random.h"
#include "asperity/simulation/render_tags.h"
#include "asperity/simulation/tag_body.h"
#include "asperity/tracking/track_body.h"
#include "tag_scene.h"

namespace asperity {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Five by four tags of 30 mm in a plane, a grid such as printed on a sheet of A4.
std::vector<MarkerPlacement> tag_board() {
  std::vector<MarkerPlacement> out;
  for (int i = 0; i < 20; ++i) {
    MarkerPlacement tag;
    tag.id = i;
    tag.family = "tag36h11";
    tag.size_m = 0.03;
    tag.T_marker_tag.translation_m = {0.04 * (i % 5 - 2), 0.04 * (i / 5 - 1.5), 0.0};
    out.push_back(tag);
  }
  return out;
}

// Bends the board, which lies in z = 0: each tag goes where the sag has its centre, and turns as the slope there.
void bend(std::vector<MarkerPlacement>& body, double share, Random& random) {
  double half_m = 0.0;
  for (const MarkerPlacement& tag : body)
    half_m = std::max(half_m, tag.T_marker_tag.translation_m.head<2>().cwiseAbs().maxCoeff() + 0.5 * tag.size_m);
  const double sag_m = share * 2.0 * half_m;
  const Eigen::Vector3d a = sag_m * Eigen::Vector3d(random.normal(), random.normal(), std::sqrt(2.0) * random.normal());
  for (MarkerPlacement& tag : body) {
    const double x = tag.T_marker_tag.translation_m.x() / half_m, y = tag.T_marker_tag.translation_m.y() / half_m;
    tag.T_marker_tag.translation_m.z() += a[0] * x * x + a[1] * y * y + a[2] * x * y;
    const double slope_x = (2.0 * a[0] * x + a[2] * y) / half_m, slope_y = (2.0 * a[1] * y + a[2] * x) / half_m;
    tag.T_marker_tag.rotation = exp_rotation({slope_y, -slope_x, 0.0}) * tag.T_marker_tag.rotation;
  }
}

}  // namespace

std::vector<SigmaCase> sigma_cases() {
  std::vector<SigmaCase> out;
  out.push_back({"exact"});
  out.push_back({"focal length 0.2 %"});
  out.back().focal = 0.002;
  out.push_back({"print scale 0.3 %"});
  out.back().print_scale = 0.003;
  out.push_back({"board bent by 0.3 %"});
  out.back().bend = 0.003;
  out.back().board = true;
  out.push_back({"tags 0.1 mm off"});
  out.back().placement_m = 0.1e-3;
  out.push_back({"moving"});
  out.back().motion_m = 1e-3;
  out.push_back({"as a camera without errors is taken"});
  out.back().focal = 0.003;
  out.back().print_scale = 0.002;
  out.back().stated = false;
  out.push_back({"board, bent, lens not quite known"});
  out.back().bend = 0.003;
  out.back().unknown_k1 = 0.02;
  out.back().board = true;
  return out;
}

SigmaRatios run_sigma_case(const SigmaCase& one, int frames, std::uint64_t seed) {
  Random random(seed);
  SigmaRatios out;
  Vector6 squares = Vector6::Zero(), noise_squares = Vector6::Zero();
  std::vector<double> mm, sigma_mm;
  SimulatedCameraConfig drawn;
  drawn.exposure_s = one.motion_m > 0.0 ? 5e-3 : 0.0;
  for (int i = 0; i < frames; ++i) {
    const bool flat = i % 2 == 0;
    const std::vector<MarkerPlacement> stated = one.board ? tag_board() : flat ? front_tag_body() : sleeve();
    std::vector<MarkerPlacement> body = stated;
    const double size = 1.0 + one.print_scale * random.normal();
    if (one.board) bend(body, one.bend, random);
    for (MarkerPlacement& tag : body) {
      tag.size_m *= size;
      tag.T_marker_tag.translation_m *= size;
      tag.T_marker_tag.translation_m +=
          one.placement_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    }
    CameraCalibration camera = camera_truth(drawn);
    const double focal = 1.0 + one.focal * random.normal(), aspect = 1.0 + one.focal / 3.0 * random.normal();
    const double sigma_centre_px = one.focal * camera.fx;
    TrackConfig config;
    if (one.stated) {
      Eigen::Matrix<double, 9, 9> covariance = Eigen::Matrix<double, 9, 9>::Zero();
      const Eigen::Vector2d f(camera.fx, camera.fy);
      covariance.topLeftCorner<2, 2>() = one.focal * one.focal * f * f.transpose();
      covariance(1, 1) += one.focal * one.focal / 9.0 * f.y() * f.y();
      covariance(2, 2) = covariance(3, 3) = sigma_centre_px * sigma_centre_px;
      camera.covariance = covariance;
      config.pose.print_scale_error = one.print_scale;
      config.pose.bend_share = one.bend;
      config.pose.placement_sigma_m = one.placement_m;
    } else {
      camera.distortion[0] += config.pose.distortion_error * random.normal();
      camera.distortion[2] += 0.05 * config.pose.distortion_error * random.normal();
      camera.distortion[3] += 0.05 * config.pose.distortion_error * random.normal();
    }
    camera.fx *= focal;
    camera.fy *= focal * aspect;
    camera.cx += sigma_centre_px * random.normal();
    camera.cy += sigma_centre_px * random.normal();
    camera.distortion[0] += one.unknown_k1 * random.normal();

    const Pose truth = random_view(random.uniform(0.25, 0.6), 0.6, seed * 1000 + static_cast<std::uint64_t>(i));
    Eigen::Vector3d way(random.normal(), random.normal(), 0.3 * random.normal());
    way *= one.motion_m / std::max(1e-12, way.norm());
    const Pose open{truth.rotation, truth.translation_m - 0.5 * way};
    const Pose close{truth.rotation, truth.translation_m + 0.5 * way};
    TagRenderer renderer(drawn, body);
    GrayImage image;
    renderer.render(open, close, static_cast<std::uint64_t>(i), image);
    BodyTracker tracker(camera, stated, config);
    const auto pose = tracker.push(image, 0);
    ++out.frames;
    if (!pose) continue;
    ++out.found;
    Vector6 e;
    e << pose->sample.T_world_marker.translation_m - truth.translation_m,
        log_rotation(pose->sample.T_world_marker.rotation * truth.rotation.conjugate());
    squares += e.cwiseAbs2().cwiseQuotient(pose->covariance.diagonal());
    noise_squares += e.cwiseAbs2().cwiseQuotient(pose->noise.diagonal());
    mm.push_back(e.head<3>().norm() * 1e3);
    sigma_mm.push_back(std::sqrt(pose->covariance.topLeftCorner<3, 3>().trace()) * 1e3);
  }
  if (out.found == 0) return out;
  out.rms = (squares / out.found).cwiseSqrt();
  out.pooled = std::sqrt(squares.sum() / (6.0 * out.found));
  out.noise_pooled = std::sqrt(noise_squares.sum() / (6.0 * out.found));
  for (auto* values : {&mm, &sigma_mm})
    std::nth_element(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2), values->end());
  out.median_mm = mm[mm.size() / 2];
  out.median_sigma_mm = sigma_mm[sigma_mm.size() / 2];
  return out;
}

}  // namespace asperity
