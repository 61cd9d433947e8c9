#include "align/align_page.h"

#include <gmock/gmock.h>

#include <cmath>

#include "align_bench.h"
#include "asperity/json/parse_json.h"
#include "asperity/registration/manual_alignment.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

class AlignPageTest : public ::testing::Test {
 protected:
  AlignBench bench_;
};

TEST_F(AlignPageTest, OpensMeshAndPathAndFindsWhatThereIs) {
  EXPECT_EQ(bench_.call("align.paths").result, parse_json(R"([{"kind":"path","name":"path.csv"}])"));
  const ReadBlock block(bench_.call("align.open").block);
  EXPECT_EQ(block.array<std::uint32_t>("indices").size(), 3 * bench_.pebble.triangles.size());
  const std::vector<float> positions = block.array<float>("positions");
  const Eigen::Vector3d origin_m = point_of_json(block.head.at("origin_m"), "");
  // Floats about the middle of 45 mm: 2 nm; written in millimetres to the last digit.
  for (std::size_t i = 0; i < bench_.pebble.vertices_m.size(); i += 97) {
    const Eigen::Vector3d p_m =
        origin_m + Eigen::Vector3d(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    EXPECT_LT((p_m - bench_.pebble.vertices_m[i]).norm(), 1e-8);
  }
  const std::vector<float> points = block.array<float>("path_points");
  ASSERT_EQ(points.size(), 3 * block.array<std::uint32_t>("path_of").size());
  const Eigen::Vector3d middle_m = point_of_json(block.head.at("middle_world_m"), "");
  for (std::size_t i = 0; i + 2 < points.size(); i += 30) {
    const Eigen::Vector3d p_m =
        bench_.T_mesh_world * Eigen::Vector3d(middle_m + Eigen::Vector3d(points[i], points[i + 1], points[i + 2]));
    EXPECT_LT(bench_.bvh.closest_point(p_m).distance_m, 60e-6);  // six times the noise
  }
}

TEST_F(AlignPageTest, SlidersAreThePose) {
  const Json pose = bench_.document.section("align").at("T_mesh_world");
  const Json six = bench_.call("align.sliders", args_of({{"pose", pose}})).result;
  const ManualAlignment expected = manual_alignment(bench_.pose());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(six["shift_m"][k], expected.shift_m[k]);
    EXPECT_EQ(six["turn_deg"][k], expected.rotation_deg[k]);
  }
  // About the path's middle: the shift is where the middle is, and turning leaves it there.
  const Json about = {0.1, 0.2, -0.3};
  Json there = bench_.call("align.sliders", args_of({{"pose", pose}, {"about_world_m", about}})).result;
  const Eigen::Vector3d middle_m = bench_.pose() * Eigen::Vector3d(0.1, 0.2, -0.3);
  EXPECT_LT((point_of_json(there["shift_m"], "") - middle_m).norm(), 1e-15);
  there["turn_deg"][0] = there["turn_deg"][0].get<double>() + 30.0;
  const Json turned =
      bench_
          .call("align.sliders",
                args_of({{"shift_m", there["shift_m"]}, {"turn_deg", there["turn_deg"]}, {"about_world_m", about}}))
          .result;
  const Pose after = pose_of_json(turned["pose"], "");
  EXPECT_LT((after * Eigen::Vector3d(0.1, 0.2, -0.3) - middle_m).norm(), 1e-15);
  EXPECT_NEAR(after.rotation.angularDistance(bench_.pose().rotation), 30.0 * std::numbers::pi / 180.0, 1e-9);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(turned["turn_deg"][k].get<double>(), there["turn_deg"][k].get<double>(), 1e-9);
  }
}

TEST_F(AlignPageTest, PickedPairsGiveThePoseAndUndoTakesItBack) {
  const Json before = bench_.document.section("align").at("T_mesh_world");
  EXPECT_THAT(bench_.call("align.pick").hint, HasSubstr("Pick more points"));
  Json picks = Json::array();
  for (const std::size_t i : {10U, 150U, 320U, 470U}) {
    Json pair;
    pair["mesh"] = json_of_point(bench_.p_mesh_m[i]);
    pair["path"] = json_of_point(bench_.T_mesh_world.inverse() * bench_.p_mesh_m[i]);
    picks.push_back(pair);
  }
  bench_.document.edit("/align/picks", picks, "picks");
  const Json found = bench_.call("align.pick").result;
  EXPECT_LT(found["rms_m"].get<double>(), 1e-12);
  EXPECT_LT(bench_.error_m(bench_.pose()), 1e-12);
  bench_.document.undo();
  EXPECT_EQ(bench_.document.section("align").at("T_mesh_world"), before);

  // On a line, the turn about it is not determined.
  for (std::size_t i = 0; i < picks.size(); ++i) picks[i]["path"] = {0.0, 0.0, 0.01 * static_cast<double>(i)};
  for (std::size_t i = 0; i < picks.size(); ++i) picks[i]["mesh"] = {0.01 * static_cast<double>(i), 0.0, 0.0};
  bench_.document.edit("/align/picks", picks, "picks");
  EXPECT_THAT(bench_.call("align.pick").error, HasSubstr("line"));
}

TEST_F(AlignPageTest, ResidualsAreThoseOfBruteForce) {
  bench_.call("align.open");
  const ReadBlock opened(bench_.call("align.open").block);
  const Eigen::Vector3d middle_m = point_of_json(opened.head.at("middle_world_m"), "");
  const std::vector<float> points = opened.array<float>("path_points");
  for (const Pose& pose : {bench_.T_mesh_world, bench_.guess(), bench_.T_mesh_world}) {
    const ReadBlock block(bench_.call("align.residuals", args_of({{"pose", json_of_pose(pose)}})).block);
    const std::vector<float> distances = block.array<float>("distance_m");
    ASSERT_EQ(3 * distances.size(), points.size());
    double sum_m = 0.0, square_m2 = 0.0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      sum_m += std::abs(distances[i]) / static_cast<double>(distances.size());
      square_m2 += distances[i] * distances[i] / static_cast<double>(distances.size());
      if (i % 60 != 0) continue;
      const Eigen::Vector3d p_m =
          pose * Eigen::Vector3d(middle_m + Eigen::Vector3d(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
      // Triangles one by one, each as a mesh of its own.
      double least_m = 1.0;
      for (const Triangle& t : bench_.pebble.triangles) {
        const auto& v = bench_.pebble.vertices_m;
        if ((v[t[0]] - p_m).norm() > least_m + 10e-3) continue;  // longer than any edge
        const MeshBvh alone(TriangleMesh{{v[t[0]], v[t[1]], v[t[2]]}, {{0, 1, 2}}});
        least_m = std::min(least_m, alone.closest_point(p_m).distance_m);
      }
      EXPECT_NEAR(std::abs(distances[i]), least_m, 1e-8);  // floats of the points about their middle
      // The pebble is about star-shaped: farther out is outside, where the sign of the distance matters.
      if (least_m > 1e-3) {
        EXPECT_EQ(distances[i] > 0.0F, p_m.norm() > bench_.bvh.closest_point(p_m).p_m.norm());
      }
    }
    EXPECT_NEAR(block.head.at("mean_m").get<double>(), sum_m, 1e-6 * sum_m);
    EXPECT_NEAR(block.head.at("rms_m").get<double>(), std::sqrt(square_m2), 1e-6 * std::sqrt(square_m2));
  }
}

TEST(JsonPose, WhatWasReadOnceStaysTheSameToTheLastDigit) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Pose pose = random_motion(0.1, 3.0, Eigen::Vector3d::Zero(), seed);
    const Json once = json_of_pose(pose_of_json(json_of_pose(pose), ""));
    EXPECT_EQ(json_of_pose(pose_of_json(once, "")), once) << seed;
  }
}

TEST_F(AlignPageTest, RefusesNonsenseAndKeepsWhatThereWas) {
  const Json before = bench_.document.section("align");
  const auto refuses = [&](const std::string& path, const Json& value) {
    EXPECT_THROW(bench_.document.edit(path, value, ""), Error) << path << " " << value.dump();
  };
  refuses("/align/T_mesh_world", parse_json("[0,0,0,1,0,0]"));
  refuses("/align/T_mesh_world", parse_json("[0,0,0,2,0,0,0]"));
  refuses("/align/T_mesh_world", parse_json("[0,0,1e9,1,0,0,0]"));
  refuses("/align/T_mesh_world", "here");
  refuses("/align/picks", parse_json(R"([{"path":[0,0,0]}])"));
  refuses("/align/mesh_unit", "furlong");
  refuses("/align/mesh_unit", "-1mm");
  refuses("/align/paths", parse_json(R"([1])"));
  refuses("/align/config", parse_json(R"({"search.rotations":"many"})"));
  refuses("/align/config", parse_json(R"({"no.such.setting":"1"})"));
  refuses("/align/else", 1);
  refuses("/align/ran", parse_json(R"({"guess":null,"paths":[],"mesh":"","mesh_unit":"mm","config":{"no":"1"}})"));
  EXPECT_EQ(bench_.document.section("align"), before);

  EXPECT_THAT(bench_.call("align.residuals", args_of({{"pose", json_of_pose(bench_.guess())}})).error,
              HasSubstr("not open"));
  EXPECT_THAT(bench_.call("align.run", args_of({{"guess", true}})).error, HasSubstr("not open"));
  EXPECT_THAT(bench_.call("align.accept", args_of({{"solution", "third"}})).error, HasSubstr("third"));
  EXPECT_THAT(bench_.call("align.write", args_of({{"name", "../out"}})).error, HasSubstr("out"));
  EXPECT_THAT(bench_.call("align.sliders", args_of({{"shift_m", {1, 2}}, {"turn_deg", {0, 0, 0}}})).error,
              HasSubstr("shift_m"));
  EXPECT_THAT(bench_.call("align.sliders", args_of({{"pose", before["T_mesh_world"]}, {"shift_m", {1, 2, 3}}})).error,
              HasSubstr("not both"));
  bench_.document.edit("/align/paths", parse_json(R"(["../../etc/passwd"])"), "");
  EXPECT_THAT(bench_.call("align.open").error, HasSubstr("passwd"));
  bench_.document.edit("/align/paths", Json::array(), "");
  EXPECT_THAT(bench_.call("align.open").hint, HasSubstr("recording"));
}

}  // namespace
}  // namespace asperity::studio
