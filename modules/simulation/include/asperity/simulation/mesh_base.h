#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/scan_base.h"
#include "asperity/simulation/surface_config.h"
#include "asperity/simulation/uniform_spline.h"

namespace asperity {

// A triangle mesh under the hand. The base is a smooth ribbon C(a) + v b(a) along a line over the mesh
// (mesh_stroke.h): the line and the mesh's interpolated normals along it, both smoothed by a Gaussian of 1 mm as
// twice differentiable splines. The mesh itself, every facet of it, is the ground over that base: where the
// ribbon's normal meets it. What the tip rolls over is thus the mesh; smoothing only chooses in which direction
// and by which coordinate heights are counted (docs/virtual-bench.md).
class MeshBase final : public ScanBase {
 public:
  static constexpr double kSmoothing_m = 1e-3;
  static constexpr double kHandSmoothing_m = 6e-3;  // of the normals that the hand's orientation follows
  static constexpr double kReach_m = 3e-3;          // of the ground from the ribbon, either way

  // The line goes through `config.through`, or over `length_m` (mesh_stroke.h). Throws Error as
  // trace_mesh_stroke does, and for an impossible pose.
  MeshBase(std::shared_ptr<const MeshSurface> surface, const SimulatedShapeConfig& config, double length_m,
           double follow_normal);

  Eigen::Vector3d point_m(double a_m, double v_m, double height_m) const override;
  Eigen::Vector3d normal(double a_m) const override;
  Eigen::Vector3d along(double a_m) const override;
  Eigen::Vector3d across(double a_m) const override;
  Eigen::Quaterniond turn(double a_m) const override;
  Ground ground(double a_m, double v_m) const override;

  double length_m() const { return length_m_; }  // of the line between its first and last picked point
  const MeshSurface& surface() const { return *surface_; }
  const Pose& T_world_mesh() const { return T_world_mesh_; }

 private:
  struct Frame {
    Eigen::Vector3d along, across, normal;
  };
  Frame frame(double a_m) const;  // in the mesh frame

  std::shared_ptr<const MeshSurface> surface_;
  UniformSpline<3> line_, normals_;
  UniformSpline<4> turns_;  // quaternions, world from world
  double length_m_ = 0.0;
  Pose T_world_mesh_;
};

}  // namespace asperity
