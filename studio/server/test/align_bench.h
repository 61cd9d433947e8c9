#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "align/align_page.h"
#include "asperity/base/output.h"
#include "asperity/base/random.h"
#include "asperity/base/text.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/random_motion.h"
#include "json_pose.h"
#include "page_rig.h"
#include "read_block.h"

namespace asperity::studio {

// A folder with a pebble in millimetres and a path that winds over its upper half with 10 µm of noise, seen from a
// world of its own; and the page over it.
class AlignBench : public PageRig<> {
 public:
  AlignBench() {
    MeshFile file;
    file.triangles = pebble.triangles;
    for (const Eigen::Vector3d& vertex_m : pebble.vertices_m) file.vertices.push_back(1e3 * vertex_m);
    write_obj(folder / "pebble.obj", file);
    for (int i = 0; i < 500; ++i) {
      const double t = 2.0 * std::numbers::pi * i / 500.0;
      const Eigen::Vector3d towards(std::cos(t), std::sin(t), 0.9 + 0.5 * std::sin(5.0 * t));
      p_mesh_m.push_back(bvh.closest_point(0.06 * towards.normalized()).p_m);
    }
    write_path("path.csv", 3);
    open(make_align_page(shared));
    document.edit("/align/paths", {"path.csv"}, "");
    document.edit("/align/mesh", "pebble.obj", "");
    document.edit("/align/mesh_unit", "mm", "");
    document.edit("/align/T_mesh_world", json_of_pose(guess()), "");
  }

  // The path measured once, with noise of its own.
  void write_path(const std::string& name, std::uint64_t seed) {
    Random random(seed);
    std::string csv = "t_ns,px_m,py_m,pz_m\n";
    for (std::size_t i = 0; i < p_mesh_m.size(); ++i) {
      const Eigen::Vector3d noise_m = 10e-6 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      const Eigen::Vector3d p_m = T_mesh_world.inverse() * Eigen::Vector3d(p_mesh_m[i] + noise_m);
      csv += std::to_string(10'000'000 * i) + "," + number_text(p_m.x()) + "," + number_text(p_m.y()) + "," +
             number_text(p_m.z()) + "\n";
    }
    write_file(folder / name, csv);
  }

  // 5 mm and 5 degrees off.
  Pose guess() const { return random_motion(5e-3, 5.0 * std::numbers::pi / 180.0, p_mesh_m[0], 4) * T_mesh_world; }

  // Does what is posted until the event has been sent so often.
  std::vector<Json> wait_for_events(const std::string& name, std::size_t count) {
    wait([&] { return hub.events(name).size() >= count; });
    return hub.events(name);
  }
  Pose pose() const { return pose_of_json(document.section("align").at("T_mesh_world"), "pose"); }

  // Root mean square of how far the pose puts the path's points from where they belong.
  double error_m(const Pose& pose) const {
    double square_m2 = 0.0;
    for (const Eigen::Vector3d& p_m : p_mesh_m) {
      square_m2 += (pose * (T_mesh_world.inverse() * p_m) - p_m).squaredNorm() / static_cast<double>(p_mesh_m.size());
    }
    return std::sqrt(square_m2);
  }

  const Pose T_mesh_world{exp_rotation({0.3, -1.2, 0.8}), {0.2, -0.1, 0.4}};
  const TriangleMesh pebble = make_pebble();
  const MeshBvh bvh{pebble};
  std::vector<Eigen::Vector3d> p_mesh_m;
};

inline Json args_of(std::initializer_list<std::pair<std::string, Json>> args) {
  Json out = Json::object();
  for (const auto& [name, value] : args) out[name] = value;
  return out;
}

}  // namespace asperity::studio
