#include "bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/simulation/make_pebble.h"

namespace bench {

namespace {

using asperity::Pose;
using Eigen::Vector3d;

Pose turned(double angle_rad, const Vector3d& axis) { return {asperity::exp_rotation(angle_rad * axis), {0, 0, 0}}; }

// One about each axis, by half a turn.
std::vector<Pose> half_turns() {
  constexpr double kHalf = std::numbers::pi;
  return {Pose{}, turned(kHalf, Vector3d::UnitX()), turned(kHalf, Vector3d::UnitY()), turned(kHalf, Vector3d::UnitZ())};
}

Pose without(const Symmetry& symmetry, const Pose& error) {
  if (symmetry.sphere) return {Eigen::Quaterniond::Identity(), error.rotation.conjugate() * error.translation_m};
  if (symmetry.axis.isZero()) return error;
  // The part of the rotation about the axis.
  const double along = error.rotation.vec().dot(symmetry.axis);
  Eigen::Quaterniond twist(error.rotation.w(), along * symmetry.axis.x(), along * symmetry.axis.y(),
                           along * symmetry.axis.z());
  if (twist.norm() < 1e-12) return error;
  twist.normalize();
  return Pose{twist.conjugate(), Vector3d::Zero()} * error;
}

void add_quad(asperity::TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

}  // namespace

PoseDifference difference_modulo(const Symmetry& symmetry, const Pose& found, const Pose& truth,
                                 const std::vector<Vector3d>& p_world_m, double limit_m, double limit_rad) {
  PoseDifference least{1e9, 1e9};
  for (const Pose& motion : symmetry.motions) {
    const Pose same = motion * truth;
    const Pose error = without(symmetry, found * same.inverse());
    double sum_m2 = 0.0;
    for (const Vector3d& p_m : p_world_m) sum_m2 += (error * (same * p_m) - same * p_m).squaredNorm();
    const PoseDifference here{std::sqrt(sum_m2 / static_cast<double>(p_world_m.size())),
                              asperity::log_rotation(error.rotation).norm()};
    const auto size = [&](const PoseDifference& d) { return std::max(d.rms_m / limit_m, d.rotation_rad / limit_rad); };
    if (size(here) < size(least)) least = here;
  }
  return least;
}

Body make_ellipsoid(const Vector3d& semi_axes_m) {
  asperity::PebbleConfig config;
  config.semi_axes_m = {semi_axes_m.x(), semi_axes_m.y(), semi_axes_m.z()};
  config.bump_m = 0.0;
  Body out{"ellipsoid", asperity::make_pebble(config), {}};
  out.symmetry.motions = half_turns();
  return out;
}

Body make_sphere(double radius_m) {
  Body out = make_ellipsoid(Vector3d::Constant(radius_m));
  out.name = "sphere";
  out.symmetry = {};
  out.symmetry.sphere = true;
  return out;
}

Body make_box(const Vector3d& sides_m) {
  Body out{"box", {}, {}};
  for (int i = 0; i < 8; ++i) {
    out.mesh.vertices_m.emplace_back(
        0.5 * sides_m.cwiseProduct(Vector3d((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : kFaces) add_quad(out.mesh, a, b, c, d);
  out.symmetry.motions = half_turns();
  return out;
}

Body make_prism(int sides, double radius_m, double height_m) {
  Body out{"prism", {}, {}};
  const auto n = static_cast<std::uint32_t>(sides);
  const double step_rad = 2.0 * std::numbers::pi / sides;
  for (int i = 0; i < sides; ++i) {
    for (const double z_m : {-0.5 * height_m, 0.5 * height_m}) {
      out.mesh.vertices_m.emplace_back(radius_m * std::cos(i * step_rad), radius_m * std::sin(i * step_rad), z_m);
    }
  }
  out.mesh.vertices_m.emplace_back(0.0, 0.0, -0.5 * height_m);
  out.mesh.vertices_m.emplace_back(0.0, 0.0, 0.5 * height_m);
  out.symmetry.motions.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    add_quad(out.mesh, 2 * i, 2 * next, 2 * next + 1, 2 * i + 1);
    out.mesh.triangles.push_back({2 * n, 2 * next, 2 * i});
    out.mesh.triangles.push_back({2 * n + 1, 2 * i + 1, 2 * next + 1});
    const Pose about = turned(i * step_rad, Vector3d::UnitZ());
    out.symmetry.motions.push_back(about);
    out.symmetry.motions.push_back(about * turned(std::numbers::pi, Vector3d::UnitX()));
  }
  return out;
}

Body make_cylinder(double radius_m, double height_m) {
  Body out = make_prism(240, radius_m, height_m);
  out.name = "cylinder";
  out.symmetry.motions = {Pose{}, turned(std::numbers::pi, Vector3d::UnitX())};
  out.symmetry.axis = Vector3d::UnitZ();
  return out;
}

Body make_bumpy_pebble(std::uint64_t seed) {
  asperity::Random random(seed, 31);
  asperity::PebbleConfig config;
  config.seed = static_cast<std::int64_t>(seed % 1000000007);
  config.bump_m = random.uniform(0.8e-3, 1.8e-3);
  config.bump_length_m = random.uniform(18e-3, 35e-3);
  for (double& axis_m : config.semi_axes_m) axis_m = random.uniform(25e-3, 50e-3);
  return {"pebble", asperity::make_pebble(config), {}};
}

Body mirrored(const Body& body) {
  Body out{body.name + " mirrored", body.mesh, {}};
  for (Vector3d& vertex_m : out.mesh.vertices_m) vertex_m.x() = -vertex_m.x();
  for (auto& triangle : out.mesh.triangles) std::swap(triangle[1], triangle[2]);
  return out;
}

Body read_body(const std::string& file, double longest_m) {
  const asperity::MeshFile read = asperity::read_mesh(file);
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : read.vertices) box.extend(vertex);
  Body out{
      std::filesystem::path(file).stem().string(), asperity::to_metres(read, longest_m / box.sizes().maxCoeff()), {}};
  const Vector3d centre_m = longest_m / box.sizes().maxCoeff() * box.center();
  for (Vector3d& vertex_m : out.mesh.vertices_m) vertex_m -= centre_m;
  return out;
}

}  // namespace bench
