#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "asperity/geometry/pose.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

// Scans between which the object moved (seed B.2): each has its own T_mesh_world.
namespace asperity::cli {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

// The bench's pebble of seed 1, m.
std::string bench_pebble_obj() {
  const TriangleMesh mesh = make_pebble();
  std::ostringstream out;
  out.precision(9);
  for (const Vector3d& p_m : mesh.vertices_m) out << "v " << p_m.x() << ' ' << p_m.y() << ' ' << p_m.z() << '\n';
  for (const Triangle& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

const Vector3d kNormal = Vector3d(0.0, -0.9397, -0.3420).normalized();

// T_world_mesh: the pebble's z axis along the bench's normal, and moved by some centimetres and 100 degrees.
Pose first_place() {
  return {shortest_rotation(Vector3d::UnitZ(), kNormal), Vector3d(0.0, 0.06, 0.35) - 0.028 * kNormal};
}
Pose second_place() {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.75, (kNormal + Vector3d(0.2, 0.1, 0.0)).normalized()));
  return {turn * first_place().rotation, first_place().translation_m + Vector3d(0.015, -0.004, 0.012)};
}

Pose pose_from(const json& v) {
  return {Eigen::Quaterniond(v.at(3), v.at(4), v.at(5), v.at(6)), Vector3d(v.at(0), v.at(1), v.at(2))};
}

class RegisterPlacements : public testing::Test {
 protected:
  void SetUp() override { write_text(dir_ / "pebble.obj", bench_pebble_obj()); }
  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  void simulate(const std::string& name, const Pose& T_world_mesh, const std::string& through, int seed) {
    const Vector3d& p = T_world_mesh.translation_m;
    const Vector3d turn = log_rotation(T_world_mesh.rotation);
    const auto list = [](const Vector3d& v) {
      std::ostringstream out;
      out.precision(12);
      out << '[' << v.x() << ',' << v.y() << ',' << v.z() << ']';
      return out.str();
    };
    const Outcome outcome = run({"simulate",
                                 "--surface",
                                 "sandpaper",
                                 "--probe",
                                 "open",
                                 "--speed",
                                 "25mm/s",
                                 "--seed",
                                 std::to_string(seed),
                                 "--mesh",
                                 path("pebble.obj"),
                                 "--through=" + through,
                                 "--set",
                                 "shape.mesh_pose=given",
                                 "--set",
                                 "shape.mesh_position_m=" + list(p),
                                 "--set",
                                 "shape.mesh_rotation_rad=" + list(turn),
                                 "-o",
                                 path(name)});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  json register_scans(const Words& more) {
    Words words{"register", path("a"), path("b"), path("c"), path("pebble.obj"), "-o", path("out"), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_THAT(outcome.code, ::testing::AnyOf(0, 3)) << outcome.err;
    return json::parse(outcome.out);
  }
  // The displacement of the pebble's middle and the rotation from the truth, of each scan.
  static double error_mm(const json& scan, const Pose& T_world_mesh) {
    return 1e3 * (pose_from(scan.at("T_mesh_world")) * T_world_mesh.translation_m).norm();
  }

  const testkit::TempDir dir_;
};

constexpr const char* kBent =
    "-0.034,-0.012,0.0158;-0.02,0.008,0.0243;0,0.016,0.0251;0.02,0.008,0.0243;0.034,-0.012,0.0158";
constexpr const char* kOther =
    "-0.01,-0.027,0.017;0.012,-0.012,0.0255;0.008,0.008,0.027;-0.012,0.02,0.022;-0.028,0.012,0.02";

TEST_F(RegisterPlacements, ATurnedObjectIsFoundOutAndStated) {
  simulate("a", first_place(), kBent, 1);
  simulate("b", first_place(), kOther, 2);
  simulate("c", second_place(), kBent, 3);
  const json found = register_scans({});
  ASSERT_EQ(found.at("placements").size(), 2U);
  EXPECT_EQ(found.at("placements").at(0).at("scans"), (json{"a", "b"}));
  EXPECT_EQ(found.at("placements").at(1).at("scans"), (json{"c"}));
  EXPECT_EQ(found.at("T_mesh_world"), found.at("placements").at(0).at("T_mesh_world"));
  const json& scans = found.at("scans");
  EXPECT_EQ(scans.at(0).at("placement"), 1);
  EXPECT_EQ(scans.at(2).at("placement"), 2);
  EXPECT_EQ(scans.at(0).at("T_mesh_world"), scans.at(1).at("T_mesh_world"));
  for (const json& scan : scans) {
    EXPECT_EQ(scan.at("covariance").at("matrix").size(), 6U);
    EXPECT_TRUE(scan.at("rms_m").is_number());
    EXPECT_TRUE(scan.at("verdict").is_string());
  }
  // Two bent strokes fix the first to a fraction of a millimetre; one fixes the second less well.
  EXPECT_LT(error_mm(scans.at(0), first_place()), 1.5);
  EXPECT_LT(error_mm(scans.at(2), second_place()), 3.0);

  const json stated = register_scans({"--placement", "1,1,2"});
  EXPECT_EQ(stated.at("placements").size(), 2U);
  EXPECT_LT(error_mm(stated.at("scans").at(0), first_place()), 1.5);
  EXPECT_EQ(register_scans({"--placement", "same"}).at("placements").size(), 1U);
  EXPECT_EQ(register_scans({"--placement", "each"}).at("placements").size(), 3U);
}

TEST_F(RegisterPlacements, ScansOfOnePlacementAreNotParted) {
  simulate("a", first_place(), kBent, 4);
  simulate("b", first_place(), kOther, 5);
  simulate("c", first_place(), kBent, 6);
  const json found = register_scans({});
  EXPECT_EQ(found.at("placements").size(), 1U);
  EXPECT_LT(error_mm(found, first_place()), 1.5);
}

TEST_F(RegisterPlacements, AListThatFitsNoPathsIsAUsageError) {
  simulate("a", first_place(), kBent, 7);
  for (const char* list : {"1,2", "1,x", "0", "1.5", ",", "some"}) {
    const Outcome outcome = run({"register", path("a"), path("pebble.obj"), "--placement", list, "-o", path("out")});
    EXPECT_EQ(outcome.code, 2) << list;
    EXPECT_THAT(outcome.err, HasSubstr("--placement")) << list;
  }
}

}  // namespace
}  // namespace asperity::cli
