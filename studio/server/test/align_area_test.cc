#include "align/align_area.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>

#include <Eigen/LU>

#include "align/align_page.h"
#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/base/random.h"
#include "asperity/json/parse_json.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/write_area.h"
#include "page_rig.h"
#include "read_block.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kSide = 30;  // mm, of the plate
constexpr int kStrokes = 16;

// Waves of 1 to 3.3 mm in all directions, 5 µm each.
double relief_m(double x_mm, double y_mm, int of) {
  Random random(static_cast<std::uint64_t>(of));
  double out = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double f = random.uniform(0.3, 1.0), angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    out += 5e-6 * std::cos(2.0 * std::numbers::pi * f * (x_mm * std::cos(angle) + y_mm * std::sin(angle)) + phase);
  }
  return out;
}

// What `register` leaves of strokes that cross on a plate, each with an offset of its own; `own`: and with a relief of
// its own.
void write_registered(const fs::path& folder, bool own) {
  fs::create_directories(folder);
  std::ostringstream mesh;
  for (int r = 0; r <= kSide; ++r)
    for (int c = 0; c <= kSide; ++c) mesh << "v " << c << ' ' << r << " 0\n";
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int a = (kSide + 1) * r + c + 1, b = a + kSide + 1;
      mesh << "f " << a << ' ' << a + 1 << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << b << '\n';
    }
  }
  write_file(folder / "plate.obj", mesh.str());
  write_file(folder / "scene.json",
             R"({"format": "asperity-scene", "version": 1, "mesh": "plate.obj", "unit_m": 0.001, "textures": []})");
  Json registration{
      {"format", "asperity-registration"}, {"version", 1}, {"trustworthy", true}, {"scans", Json::array()}};
  for (int k = 0; k < kStrokes; ++k) {
    const std::string scan = "scan" + std::to_string(k);
    registration["scans"].push_back(Json{{"name", scan}});
    fs::create_directories(folder / scan);
    std::ostringstream path, profile;
    path << "s_m,px_m,py_m,pz_m,triangle\n";
    profile << "s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m\n";
    const double lane = 10.2 + 1.2 * (k % 8);
    for (int i = 0; i <= 240; ++i) {
      const double s = 0.05 * i, along = 8.0 + s;
      const double x = k < 8 ? along : lane, y = k < 8 ? lane : along;
      const int column = static_cast<int>(x), row = static_cast<int>(y);
      const int triangle = 2 * (kSide * row + column) + (x - column < y - row ? 1 : 0);
      path << 1e-3 * s << ',' << 1e-3 * x << ',' << 1e-3 * y << ",0," << triangle << '\n';
      const double height = relief_m(x, y, own ? 100 + k : 1) + 2e-5 * (k % 5);
      profile << 1e-3 * s << ',' << height << ",1e-5,0,0.5,0.02,2e-6\n";
    }
    write_file(folder / scan / "path.csv", path.str());
    write_file(folder / scan / "profile.csv", profile.str());
  }
  write_file(folder / "registration.json", registration.dump(2));
}

class AlignAreaTest : public ::testing::Test, protected PageRig<> {
 protected:
  AlignAreaTest() {
    write_registered(folder / "registered", false);
    open(make_align_page(shared));
    choose("registered");
  }

  void choose(const std::string& name) {
    document.edit("/align/area", Json{{"folder", name}, {"config", Json{{"map.held_out", "4"}}}}, "choose");
  }
};

TEST_F(AlignAreaTest, MakesAndWritesAsTheCommandLine) {
  EXPECT_EQ(call("align.registered").result, parse_json(R"(["registered"])"));
  const FakeHub::Answer answer = call("align.area");
  ASSERT_EQ(answer.error, "");
  const ReadBlock block(answer.block);

  AreaConfig config;
  config.map.held_out = 4;
  const AreaInput input = read_area_input(folder / "registered");
  const SceneObject& object = input.scene.objects.front();
  const AreaResult area = make_area(to_metres(object.mesh, object.unit_m), input.scans, input.registered, config);
  EXPECT_EQ(block.head["area"], parse_json(format_area(area, input.scans, "")));

  // The map under the corners of the textured triangles is the relief there, up to one offset.
  const auto columns = block.head["map"]["columns"].get<std::size_t>();
  const auto rows = block.head["map"]["rows"].get<std::size_t>();
  const double spacing_mm = 1e3 * block.head["map"]["spacing_m"].get<double>();
  const auto height_m = block.array<float>("height_m");
  const auto supported = block.array<std::uint8_t>("supported");
  const auto triangle = block.array<std::uint32_t>("triangle");
  const auto xy_mm = block.array<float>("xy_mm");
  ASSERT_EQ(height_m.size(), rows * columns);
  ASSERT_EQ(block.array<float>("sigma_m").size(), rows * columns);
  ASSERT_EQ(xy_mm.size(), 6 * triangle.size());
  ASSERT_GT(triangle.size(), 50U);
  // The plate is its own plane: from (x, y, 1) of the map to its millimetres, by the corners of all triangles.
  Eigen::MatrixXd in_map(3 * triangle.size(), 3), on_plate(3 * triangle.size(), 2);
  for (std::size_t i = 0; i < 3 * triangle.size(); ++i) {
    const Eigen::Vector3d& corner = object.mesh.vertices[object.mesh.triangles[triangle[i / 3]][i % 3]];
    in_map.row(static_cast<Eigen::Index>(i)) << xy_mm[2 * i], xy_mm[2 * i + 1], 1.0;
    on_plate.row(static_cast<Eigen::Index>(i)) << corner.x(), corner.y();
  }
  const Eigen::MatrixXd to_plate = (in_map.transpose() * in_map).inverse() * (in_map.transpose() * on_plate);
  EXPECT_LT((in_map * to_plate - on_plate).cwiseAbs().maxCoeff(), 1e-3);
  double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t at = 0; at < height_m.size(); ++at) {
    if (supported[at] == 0) continue;
    const Eigen::RowVector3d xy1(spacing_mm * static_cast<double>(at % columns),
                                 spacing_mm * static_cast<double>(at / columns), 1.0);
    const Eigen::RowVector2d on = xy1 * to_plate;
    const double is = height_m[at], should = relief_m(on.x(), on.y(), 1);
    n += 1.0;
    a += is;
    b += should;
    aa += is * is;
    bb += should * should;
    ab += is * should;
  }
  ASSERT_GT(n, 100.0);
  // Waves of 1 mm between lanes 1.2 mm apart: not all of it.
  EXPECT_GT((n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b)), 0.8);

  const Json number = block.head["number"];
  const FakeHub::Answer written = call("align.area_write", Json{{"name", "area"}, {"number", number}});
  ASSERT_EQ(written.error, "");
  EXPECT_EQ(written.result["files"], parse_json(R"(["area.height.png","area.normal.png","area.sigma.png"])"));
  EXPECT_EQ(written.result["command"], "asperity area 'registered' --set 'map.held_out=4' -o 'area'");
  fs::create_directories(folder / "by_hand");
  write_area(folder / "by_hand", input, area);
  for (const auto& entry : fs::directory_iterator(folder / "by_hand")) {
    const fs::path name = entry.path().filename();
    EXPECT_EQ(read_file(entry.path(), 1U << 30U), read_file(folder / "area" / name, 1U << 30U)) << name;
  }
  // Only what was shown last is written, and never over something else.
  EXPECT_THAT(call("align.area_write", Json{{"name", "other"}, {"number", number.get<int>() + 1}}).hint,
              HasSubstr("Make the area again"));
  EXPECT_THAT(call("align.area_write", Json{{"name", "area"}, {"number", number}}).error, HasSubstr("exists already"));
  for (const char* itself : {"registered", "./registered", "area/../registered"})
    EXPECT_NE(call("align.area_write", Json{{"name", itself}, {"number", number}, {"replace", true}}).error, "");
  write_listing(folder / "registered");  // as if it were of another area
  EXPECT_THAT(call("align.area_write", Json{{"name", "registered"}, {"number", number}, {"replace", true}}).error,
              HasSubstr("contains the scans of the area"));
  EXPECT_TRUE(fs::exists(folder / "registered" / "scan3" / "path.csv"));
}

TEST_F(AlignAreaTest, StrokesThatDoNotAgreeAreShownAndNotWritten) {
  write_registered(folder / "apart", true);
  choose("apart");
  const FakeHub::Answer answer = call("align.area");
  ASSERT_EQ(answer.error, "");
  const Json head = ReadBlock(answer.block).head;
  EXPECT_FALSE(head["area"]["trustworthy"].get<bool>());
  EXPECT_THAT(head["area"]["verdict"].get<std::string>(), HasSubstr("the strokes do not agree"));
  EXPECT_THAT(call("align.area_write", Json{{"name", "none"}, {"number", head["number"]}}).error,
              HasSubstr("the strokes do not agree"));
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST_F(AlignAreaTest, ErrorsNameFileAndValue) {
  choose("");
  EXPECT_THAT(call("align.area").hint, HasSubstr("Choose a folder"));
  choose("nowhere");
  EXPECT_THAT(call("align.area").error, HasSubstr("nowhere"));
  choose("../registered");
  EXPECT_NE(call("align.area").error, "");
  choose("registered");
  write_file(folder / "registered" / "scan3" / "path.csv", "s_m,px_m,py_m,pz_m,triangle\n0,0,0,0,99999\n");
  EXPECT_THAT(call("align.area").error, HasSubstr("scan3/path.csv:2: column 'triangle': 99999 is not a triangle"));
  for (const char* bad :
       {R"(["/align/area/config", {"map.nothing": "1"}])", R"(["/align/area/config", {"map.held_out": "x"}])",
        R"(["/align/area", {}])", R"(["/align/area/folder", 1])"}) {
    const Json json = parse_json(bad);
    EXPECT_THROW(document.edit(json[0].get<std::string>(), json[1], "bad"), Error) << bad;
  }
}

TEST_F(AlignAreaTest, IsCancelled) {
  int asked = 0;
  const Observer observer{{}, [&] { return asked++ > 3; }};
  EXPECT_THROW(make_align_area("registered", folder / "registered", {}, observer), Cancelled);
}

}  // namespace
}  // namespace asperity::studio
