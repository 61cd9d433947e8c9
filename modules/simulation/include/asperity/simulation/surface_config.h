#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace asperity {

enum class SurfaceKind { kSine, kProtoboard, kCableTie, kSandpaper, kClayPot, kFile };
inline constexpr std::array<std::string_view, 6> kSurfaceNames = {"sine",      "protoboard", "cable_tie",
                                                                  "sandpaper", "clay_pot",   "file"};

// What is scanned. The kinds differ in the fields they use; lengths in metres.
struct SimulatedSurfaceConfig {
  SurfaceKind kind = SurfaceKind::kSine;

  double pitch_m = 2.0e-3;      // sine, protoboard, cable tie: period along the stroke
  double amplitude_m = 0.1e-3;  // sine: half of the height from valley to peak

  double hole_depth_m = 1.5e-3;             // protoboard (thesis §6.2)
  double hole_diameter_m = 0.7e-3;          // protoboard: at the hole's floor
  double hole_opening_diameter_m = 2.1e-3;  // protoboard: at the board's face

  double tooth_height_m = 0.4e-3;  // cable tie
  double tooth_rise = 0.75;        // cable tie: part of the pitch in which a tooth rises; the rest falls

  double rq_m = 40e-6;              // sandpaper, clay pot: root mean square height before the tip
  double low_cycles_per_mm = 0.25;  // sandpaper, clay pot: band of the relief
  double high_cycles_per_mm = 2.5;
  double slope = 1.0;     // sandpaper, clay pot: the waves' density falls as frequency^-slope
  std::int64_t seed = 0;  // sandpaper, clay pot: of the relief; 0: the simulation's

  std::string file;             // file: an instrument's file, a TIFF or a table (load_surface.h)
  double file_spacing_m = 0.0;  // file with heights alone: their distance; 0: 0.5 µm, of a TIFF not given
  double file_unit_m = 1e-6;    // file whose columns name no unit, and a TIFF: that of the heights
  std::string file_units;       // file: of an instrument's table whose header lines state none, as mm,um
  double file_scale = 1.0;      // file: factor on the heights

  template <class V>
  void visit(V& v) {
    v.choice("kind", kind, kSurfaceNames, "relief");
    v.field("pitch_m", pitch_m, "sine, protoboard, cable_tie: period along the stroke, m", {1e-5, 1.0});
    v.field("amplitude_m", amplitude_m, "sine: half of the height from valley to peak, m", {0.0, 0.1});
    v.field("hole_depth_m", hole_depth_m, "protoboard: depth of a hole, m", {0.0, 0.1});
    v.field("hole_diameter_m", hole_diameter_m, "protoboard: diameter of a hole at its floor, m", {0.0, 0.1});
    v.field("hole_opening_diameter_m", hole_opening_diameter_m, "protoboard: diameter of a hole at the face, m",
            {0.0, 0.1});
    v.field("tooth_height_m", tooth_height_m, "cable_tie: height of a tooth, m", {0.0, 0.1});
    v.field("tooth_rise", tooth_rise, "cable_tie: part of the pitch in which a tooth rises", {0.01, 0.99});
    v.field("rq_m", rq_m, "sandpaper, clay_pot: root mean square height before the tip, m", {0.0, 0.01});
    v.field("low_cycles_per_mm", low_cycles_per_mm, "sandpaper, clay_pot: lower end of the relief's band, 1/mm",
            {1e-3, 100.0});
    v.field("high_cycles_per_mm", high_cycles_per_mm, "sandpaper, clay_pot: upper end of the relief's band, 1/mm",
            {1e-3, 100.0});
    v.field("slope", slope, "sandpaper, clay_pot: the waves' density falls as frequency^-slope", {-4.0, 6.0});
    v.field("seed", seed, "sandpaper, clay_pot: of the relief, the same in several scans; 0: the simulation's",
            {0.0, 9e15});
    v.field("file", file, "file: heights of an instrument, a TIFF, or a table such as x_mm,y_mm,z_um");
    v.field("file_spacing_m", file_spacing_m,
            "file with heights alone: their distance, m; 0: 0.5 µm, and not given for a TIFF", {0.0, 0.01});
    v.field("file_unit_m", file_unit_m, "file whose columns name no unit, and a TIFF: the unit of the heights, m",
            {1e-12, 10.0});
    v.field("file_units", file_units, "file: of a table's columns where no header line states them: mm,um or mm,mm,um");
    v.field("file_scale", file_scale, "file: factor on the heights", {-1e6, 1e6});
  }
};

enum class BaseShapeKind { kPlane, kCylinder, kMesh };
inline constexpr std::array<std::string_view, 3> kSimulatedShapeNames = {"plane", "cylinder", "mesh"};

// The pose of a mesh: its path's middle at that of a plane's, or a given pose.
enum class MeshPose { kInPlace, kGiven };
inline constexpr std::array<std::string_view, 2> kMeshPoseNames = {"in_place", "given"};

// The base shape in the world frame (camera: x right, y down, z forward) and where it is.
struct SimulatedShapeConfig {
  BaseShapeKind kind = BaseShapeKind::kPlane;
  double cylinder_radius_m = 0.06;                        // its axis is across the stroke
  std::array<double, 3> centre_m{0.0, 0.06, 0.35};        // the middle of the stroke
  std::array<double, 3> normal{0.0, -0.9397, -0.3420};    // outward: up and 20 degrees towards the camera
  std::array<double, 3> stroke_direction{1.0, 0.0, 0.0};  // made perpendicular to the normal

  std::string mesh_file;                             // mesh: see read_mesh.h
  double mesh_unit_m = 0.0;                          // mesh: the length of the file's unit; 0: not stated
  std::string through;                               // mesh: the path's points "x,y,z;…" in the mesh frame, m
  MeshPose mesh_pose = MeshPose::kInPlace;           // mesh
  std::array<double, 3> mesh_position_m{0, 0, 0};    // mesh, given: T_world_mesh
  std::array<double, 3> mesh_rotation_rad{0, 0, 0};  // mesh, given: T_world_mesh, a rotation vector

  template <class V>
  void visit(V& v) {
    v.choice("kind", kind, kSimulatedShapeNames,
             "base shape; a cylinder is scanned across its axis, a mesh along through");
    v.field("cylinder_radius_m", cylinder_radius_m, "radius of the cylinder, m", {1e-3, 10.0});
    v.field("centre_m", centre_m, "middle of the stroke in the world frame, m", {-10.0, 10.0});
    v.field("normal", normal, "outward normal at the middle, world frame; need not be a unit vector", {-1.0, 1.0});
    v.field("stroke_direction", stroke_direction, "direction of the stroke at the middle, world frame", {-1.0, 1.0});
    v.field("mesh_file", mesh_file, "mesh: its file, OBJ, PLY, STL or glTF");
    v.field("mesh_unit_m", mesh_unit_m,
            "mesh: the length of the file's unit, m, from 1e-9; 0: not stated, a metre if the mesh is then 1 mm to 5 m",
            {0.0, 1e3});
    v.field("through", through, "mesh: points of the path, x,y,z;x,y,z;... in the mesh frame, m; empty: chosen");
    v.choice("mesh_pose", mesh_pose, kMeshPoseNames,
             "mesh: in_place puts the path's middle at centre_m with that normal and direction; given: as below");
    v.field("mesh_position_m", mesh_position_m, "mesh, given: its origin in the world frame, m", {-1000.0, 1000.0});
    v.field("mesh_rotation_rad", mesh_rotation_rad, "mesh, given: rotation vector from mesh to world, rad",
            {-6.3, 6.3});
  }
};

}  // namespace asperity
