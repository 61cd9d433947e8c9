// What `register` refuses, and what it leaves out.
#include <gmock/gmock.h>

#include "register_fixture.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using nlohmann::json;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

// A guess that is stated to be much better than it is ends at a pose that its own numbers refuse.
TEST_F(Register, AGuessThatIsWrongByManyOfItsSigmasIsRefused) {
  simulate("rec", "sandpaper", through({{0.0, -0.4}, {0.9, 0.7}, {1.8, -0.3}}), 2);
  const Pose truth = pose_of(read_json(dir_ / "rec" / "recording.json").at("extra").at("T_mesh_world"));
  const Outcome outcome =
      run({"register", path("rec"), mesh(), "--mesh-unit", "mm", "-o", path("out"), "--json", "--guess",
           text_of(off_by(truth, 50e-3, 0.17)), "--set", "search.registration.guess_sigma_m=0.002", "--set",
           "search.registration.guess_sigma_deg=3"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  std::vector<std::string> codes;
  const json result = json::parse(outcome.out);
  for (const json& verdict : result.at("verdicts")) codes.push_back(verdict.at("code"));
  EXPECT_THAT(codes, ::testing::AnyOf(::testing::Contains("pose_misfit"), ::testing::Contains("guess_contradicted")));
}

TEST_F(Register, BadInputIsNamed) {
  write_path("path.csv", kTruth, 0.0);
  write_text(dir_ / "bad.csv", "px_m,py_m,pz_m\n0,0,zero\n");
  write_text(dir_ / "bad.obj", "v 0 0 0\nv 1 abc 0\n");
  const auto outcome = [&](const Words& words) {
    Words all{"register"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"-o", path("out")});
    return run(all);
  };
  const Outcome cell = outcome({path("bad.csv"), mesh(), "--mesh-unit", "mm"});
  EXPECT_EQ(cell.code, 1);
  EXPECT_THAT(cell.err, HasSubstr("bad.csv:2: column 'pz_m'"));
  const Outcome vertex = outcome({path("path.csv"), path("bad.obj")});
  EXPECT_EQ(vertex.code, 1);
  EXPECT_THAT(vertex.err, HasSubstr("bad.obj:2"));
  write_text(dir_ / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  const Outcome points = outcome({path("path.csv"), path("points.obj")});
  EXPECT_EQ(points.code, 1);
  EXPECT_THAT(points.err, HasSubstr("points.obj: holds no faces"));
  EXPECT_EQ(outcome({path("path.csv")}).code, 2);
  EXPECT_EQ(outcome({path("path.csv"), mesh(), "--mesh-unit", "mm", "--guess", "1,2,3"}).code, 2);
  EXPECT_EQ(outcome({path("path.csv"), mesh(), "--mesh-unit", "kg"}).code, 2);
  EXPECT_FALSE(fs::exists(dir_ / "out"));
}

TEST_F(Register, AMeshInUnconnectedPartsIsRegisteredWithoutCoordinates) {
  // The pebble cut along a parallel that the path crosses, its rows no longer joined there.
  std::istringstream in(pebble_obj());
  std::ostringstream cut;
  int face = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("f ") && face++ / 160 == 39) continue;
    cut << line << '\n';
  }
  cut << "f 1 1 2\n";  // and a triangle that names a vertex twice
  write_text(dir_ / "cut.obj", cut.str());
  std::ostringstream path_csv;
  path_csv.precision(10);
  path_csv << "t_ns,px_m,py_m,pz_m\n";
  for (int i = 0; i < 1500; ++i) {
    const Vector3d p = kTruth * pebble_point(1e-3 * i, 0.7 * std::sin(4e-3 * i));
    path_csv << i * 1'000'000 << ',' << p.x() << ',' << p.y() << ',' << p.z() << '\n';
  }
  write_text(dir_ / "path.csv", path_csv.str());
  const Outcome outcome = run({"register", path("path.csv"), path("cut.obj"), "--mesh-unit", "mm", "--guess",
                               text_of(kTruth.inverse()), "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("haptic coordinates could not be computed"));
  const json result = json::parse(outcome.out);
  EXPECT_LT((pose_of(result.at("T_mesh_world")) * (kTruth * Vector3d::Zero())).norm(), 0.2e-3);
  EXPECT_TRUE(fs::exists(dir_ / "out" / "textured.obj"));
}

TEST_F(Register, NamesAndNumbersThatLeadAstrayAreRefused) {
  write_text(dir_ / "...csv", "px_m,py_m,pz_m\n0,0,0\n1,0,0\n0,1,0\n");
  write_text(dir_ / "a.csv", "px_m,py_m,pz_m\n0,0,0\n1,0,0\n0,1,0\n");
  const Outcome name = run({"register", path("...csv"), path("a.csv"), mesh(), "-o", path("out")});
  EXPECT_EQ(name.code, 2);
  EXPECT_THAT(name.err, HasSubstr("'..' cannot be the name"));
  write_text(dir_ / "t.csv", "t_ns,px_m,py_m,pz_m\n-9000000000000000000,0,0,0\n9000000000000000000,1,0,0\n");
  const Outcome time = run({"register", path("t.csv"), mesh(), "--mesh-unit", "mm", "-o", path("out")});
  EXPECT_EQ(time.code, 1);
  EXPECT_THAT(time.err, HasSubstr("t.csv:2: column 't_ns'"));
}

}  // namespace
}  // namespace asperity::cli
