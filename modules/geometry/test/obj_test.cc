#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/write_obj.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kData = std::filesystem::path(ASPERITY_TEST_DATA) / "obj";
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal(const std::string& text) {
  return message_of([&] { parse_obj(text, "t.obj"); });
}

TEST(Obj, Figure33ParsesAndWritesBackTheSameBytes) {
  const std::string text = read_file(kData / "figure33.obj", 1000);
  const MeshFile mesh = parse_obj(text, "figure33.obj");
  EXPECT_THAT(mesh.vertices, ElementsAre(Eigen::Vector3d(-40, 0, 40), Eigen::Vector3d(-40, 0, -40),
                                         Eigen::Vector3d(40, 0, 40), Eigen::Vector3d(40, 0, -40)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 2, 1}, Triangle{1, 2, 3}));
  ASSERT_EQ(mesh.haptic.size(), 2u);
  EXPECT_EQ(mesh.haptic[0].texture, 1);
  EXPECT_THAT(mesh.haptic[0].xy_mm, ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 50), Eigen::Vector2d(50, 0)));
  EXPECT_THAT(mesh.haptic[1].xy_mm,
              ElementsAre(Eigen::Vector2d(50, 0), Eigen::Vector2d(0, 50), Eigen::Vector2d(50, 50)));
  EXPECT_TRUE(mesh.problems.empty());
  EXPECT_EQ(format_obj(mesh), text);
}

// Every double, from the smallest subnormal to the largest that is read, and both zeros.
TEST(Obj, AugmentedMeshReadsBackBitForBit) {
  Random random(7);
  MeshFile mesh;
  const auto any = [&] {
    const double value = std::ldexp(random.uniform() - 0.5, static_cast<int>(random.uniform() * 1060.0) - 1020);
    return std::isfinite(value) ? value : 1.0;
  };
  for (int i = 0; i < 300; ++i) mesh.vertices.emplace_back(any(), any(), any());
  mesh.vertices[0] = {-0.0, std::numeric_limits<double>::denorm_min(), std::nextafter(1e12, 0.0)};
  for (int i = 0; i < 100; ++i) mesh.texture_coordinates.emplace_back(any(), any(), i % 2 == 0 ? 0.0 : any());
  for (int i = 0; i < 50; ++i) mesh.normals.emplace_back(any(), any(), any());
  mesh.objects = {"a body"};
  mesh.groups = {"front cube", "back"};
  mesh.materials.resize(2);
  mesh.materials[0].name = "glazed clay";
  mesh.materials[1].name = "raw";
  for (std::uint32_t i = 0; i < 500; ++i) {
    mesh.triangles.push_back({i % 300, (i + 1) % 300, (7 * i + 2) % 300});
    mesh.texture_corners.push_back(i % 3 == 0 ? Triangle{kNoIndex, kNoIndex, kNoIndex} : Triangle{i % 100, 1, 2});
    mesh.normal_corners.push_back(i % 5 == 0 ? Triangle{kNoIndex, kNoIndex, kNoIndex} : Triangle{i % 50, 1, 2});
    HapticTriangle haptic;
    haptic.texture = static_cast<std::int32_t>(i % 4) - 1;
    for (Eigen::Vector2d& xy : haptic.xy_mm) xy = {any(), any()};
    mesh.haptic.push_back(haptic);
  }
  mesh.parts = {{0, -1, -1, -1, 0}, {10, 0, 0, 0, 3}, {200, 0, 1, 1, 0}, {300, -1, -1, -1, 0}};
  const std::string text = format_obj(mesh);
  const MeshFile again = parse_obj(text, "again");
  EXPECT_EQ(again.vertices, mesh.vertices);
  EXPECT_TRUE(std::signbit(again.vertices[0].x()));
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.texture_coordinates, mesh.texture_coordinates);
  EXPECT_EQ(again.texture_corners, mesh.texture_corners);
  EXPECT_EQ(again.normals, mesh.normals);
  EXPECT_EQ(again.normal_corners, mesh.normal_corners);
  EXPECT_EQ(again.objects, mesh.objects);
  EXPECT_EQ(again.groups, mesh.groups);
  EXPECT_EQ(again.parts, mesh.parts);
  ASSERT_EQ(again.haptic.size(), mesh.haptic.size());
  for (std::size_t i = 0; i < mesh.haptic.size(); ++i) {
    EXPECT_EQ(again.haptic[i].texture, mesh.haptic[i].texture);
    EXPECT_EQ(again.haptic[i].xy_mm, mesh.haptic[i].xy_mm);
  }
  EXPECT_EQ(format_obj(again), text);
}

TEST(Obj, ReadsWhatExportersWrite) {
  const MeshFile mesh = parse_obj(
      "\xEF\xBB\xBF# comment with a backslash \\\n"
      "  v\t+1 2. .5e+1 # trailing\r\n"
      "v 1e2 -0 \\\n   3\r\n\r\n"
      "v 0 0 7\n"
      "vt .5\nvt 0 1 2\nvn 0 0 1\n"
      "f -3/-1/1 2/1/-1 \\\n3/2/1",
      "t.obj");
  EXPECT_THAT(mesh.vertices,
              ElementsAre(Eigen::Vector3d(1, 2, 5), Eigen::Vector3d(100, 0, 3), Eigen::Vector3d(0, 0, 7)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(mesh.texture_coordinates, ElementsAre(Eigen::Vector3d(.5, 0, 0), Eigen::Vector3d(0, 1, 2)));
  EXPECT_THAT(mesh.texture_corners, ElementsAre(Triangle{1, 0, 1}));
  EXPECT_THAT(mesh.normal_corners, ElementsAre(Triangle{0, 0, 0}));
  EXPECT_TRUE(mesh.problems.empty());
}

TEST(Obj, KeepsColoursAndFourthNumbersWhereTheyAre) {
  const MeshFile mesh = parse_obj("v 0 0 0\nv 1 0 0 .5\nv 0 1 0 1 0 .25\nv 0 0 1\nf 1 2 3\n", "t.obj");
  ASSERT_EQ(mesh.vertex_w.size(), 4u);
  EXPECT_TRUE(std::isnan(mesh.vertex_w[0]));
  EXPECT_EQ(mesh.vertex_w[1], 0.5);
  ASSERT_EQ(mesh.vertex_colours.size(), 4u);
  EXPECT_EQ(mesh.vertex_colours[2], Eigen::Vector3d(1, 0, 0.25));
  EXPECT_TRUE(std::isnan(mesh.vertex_colours[3][0]));
  EXPECT_THAT(format_obj(mesh), HasSubstr("v 1 0 0 0.5\nv 0 1 0 1 0 0.25\nv 0 0 1\n"));
}

TEST(Obj, PartsAreRunsOfTheSameNames) {
  const MeshFile mesh = parse_obj(kSquare +
                                      "f 1 2 3\no box\ng front  cube\nusemtl many, many spaces  \ns 4\nf 1 2 3 4\ng "
                                      "front cube\nf 1 2 3\ns off\ng\nf 1 2 3\n",
                                  "t.obj");
  EXPECT_THAT(mesh.groups, ElementsAre("front cube"));
  EXPECT_EQ(mesh.materials.at(0).name, "many, many spaces");
  EXPECT_THAT(mesh.parts, ElementsAre(MeshPart{0, -1, -1, -1, 0}, MeshPart{1, 0, 0, 0, 4}, MeshPart{4, 0, -1, 0, 0}));
}

TEST(Obj, NothingIsLeftOutInSilence) {
  const MeshFile mesh = parse_obj(
      kSquare + "p 1\np 2\nl 1 2\nvp 0 1\ncurv 0 1 1 2\ncurv 0 1 1 2\nf 1 2 2\nf 1 2 3\ncall x.obj\n", "t.obj");
  std::vector<std::string> found;
  for (const Problem& p : mesh.problems) found.push_back(p.kind + " x" + std::to_string(p.count) + " " + p.message);
  EXPECT_THAT(
      found,
      ElementsAre("points x2 t.obj:5: point elements are left out", "lines x1 t.obj:7: line elements are left out",
                  "statement vp x1 t.obj:8: 'vp' is not read", "statement curv x2 t.obj:9: 'curv' is not read",
                  "repeated_vertex x1 t.obj:11: a triangle has the same vertex twice",
                  "statement call x1 t.obj:13: 'call' is not read"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Obj, RefusalsNameFileLineAndValue) {
  EXPECT_EQ(refusal("v 1 2\n"), "t.obj:1: 'v' has 2 numbers, it needs 3");
  EXPECT_EQ(refusal("v 1 abc 3\n"), "t.obj:1: 'abc' is not a number");
  EXPECT_EQ(refusal("\nv 1 2 3x\n"), "t.obj:2: '3x' is not a number");
  EXPECT_EQ(refusal("v 1 2 3 4 5\n"), "t.obj:1: 'v' has 5 numbers; x y z, x y z w or x y z r g b are known");
  EXPECT_EQ(refusal("v 1 2 3 4 5 6 7\n"), "t.obj:1: '7' after 6 numbers of 'v'");
  EXPECT_EQ(refusal("v 1 2 -1e20\n"), "t.obj:1: '-1e20' is beyond 1e12");
  EXPECT_EQ(refusal("v 1 2 nan\n"), "t.obj:1: 'nan' is not a finite number");
  EXPECT_EQ(refusal("v 1 2 -inf\n"), "t.obj:1: '-inf' is not a finite number");
  EXPECT_EQ(refusal("v 1 2 1e999\n"), "t.obj:1: '1e999' is out of range of a double");
  EXPECT_EQ(refusal("v 1 2 0x10\n"), "t.obj:1: '0x10' is not a number");
  EXPECT_EQ(refusal(kSquare + "f 1 2 5\n"), "t.obj:5: '5' names vertex 5, 4 are defined so far");
  EXPECT_EQ(refusal(kSquare + "f 1 2 -5\n"), "t.obj:5: '-5' names vertex -5, 4 are defined so far");
  EXPECT_EQ(refusal(kSquare + "f 0 1 2\n"), "t.obj:5: '0' has index 0; indices begin at 1");
  EXPECT_EQ(refusal(kSquare + "f 1 2\n"), "t.obj:5: a face of 2 corners, it needs 3");
  EXPECT_EQ(refusal(kSquare + "f 1,2,3\n"), "t.obj:5: '1,2,3' is not a corner of a face");
  EXPECT_EQ(refusal(kSquare + "f 1/2/3/4 1 1\n"),
            "t.obj:5: '1/2/3/4' names texture coordinate 2, 0 are defined so far");
  EXPECT_EQ(refusal(kSquare + "f 99999999999999999999 1 2\n"),
            "t.obj:5: '99999999999999999999' is not a corner of a face");
  EXPECT_THAT(refusal(kSquare + "vt 0 0\nf 1/1 2 3\n"), HasSubstr("t.obj:6: '2': some corners"));
  EXPECT_THAT(refusal(kSquare + "vn 0 0 1\nf 1//1 2//1 3\n"), HasSubstr("t.obj:6: '3': some corners"));
  EXPECT_EQ(refusal(kSquare + "s on\n"), "t.obj:5: smoothing group 'on' is neither a number nor off");
  EXPECT_EQ(refusal(""), "t.obj: holds no vertices ('v' lines)");
  EXPECT_EQ(refusal("\xFE\xFF v"), "t.obj: is UTF-16 text; save it as UTF-8 or ASCII");
  EXPECT_THAT(refusal(std::string("v\0 \0", 4)), HasSubstr("binary or UTF-16"));
  EXPECT_THAT(refusal("v 0 0 0\rv 1 0 0\r"), HasSubstr("t.obj:1: a carriage return inside the line"));
  EXPECT_EQ(refusal("v 1 \\\n2 \\\n\x01\n"), "t.obj:1: '\\x01' is not a number");
}

TEST(Obj, HapticLinesAreRefusedUnlessOneAFace) {
  const std::string h = "h 1 0 0 0 0 0 0\n";
  const std::string face = "f 1 2 3\n";
  EXPECT_EQ(refusal(kSquare + face + face + h), "t.obj:7: 1 'h' lines for 2 faces; each face needs one");
  EXPECT_EQ(refusal(kSquare + face + h + h), "t.obj:7: more 'h' lines than faces (1)");
  EXPECT_EQ(refusal(kSquare + h + face), "t.obj:5: more 'h' lines than faces (0)");
  EXPECT_EQ(refusal(kSquare + face + h + face), "t.obj:7: a face after the first 'h' line; they follow the faces");
  EXPECT_THAT(refusal(kSquare + "f 1 2 3 4\n" + h + h),
              HasSubstr("t.obj:6: 'h' lines need a file of triangles; the face of line 5"));
  EXPECT_EQ(refusal(kSquare + face + "h 1 0 0 0 0 0\n"), "t.obj:6: 'h' has 5 coordinates, it needs 6");
  EXPECT_EQ(refusal(kSquare + face + "h 1 0 0 0 0 0 0 0\n"), "t.obj:6: '0' after the 6 coordinates of 'h'");
  EXPECT_EQ(refusal(kSquare + face + "h -2 0 0 0 0 0 0\n"),
            "t.obj:6: texture index '-2' is not a whole number of -1 or more");
  EXPECT_EQ(refusal(kSquare + face + "h 1.5 0 0 0 0 0 0\n"),
            "t.obj:6: texture index '1.5' is not a whole number of -1 or more");
}

TEST(Obj, LimitsHoldBeforeMemoryIsTaken) {
  MeshLimits limits;
  limits.vertices = 4;
  limits.triangles = 2;
  limits.polygon_corners = 5;
  limits.line_bytes = 40;
  limits.file_bytes = 200;
  const auto refused = [&](const std::string& text) { return message_of([&] { parse_obj(text, "t.obj", limits); }); };
  EXPECT_EQ(refused(kSquare + "f 1 2 3 4\n"), "no error");
  EXPECT_EQ(refused(kSquare + "v 0 0 0\n"), "t.obj:5: more than 4 vertices");
  EXPECT_EQ(refused(kSquare + "f 1 2 3 4 1\n"), "t.obj:5: more than 2 triangles");
  EXPECT_EQ(refused(kSquare + "f 1 2 3 4 1 2\n"), "t.obj:5: a face of more than 5 corners");
  EXPECT_EQ(refused("# " + std::string(50, 'x')), "t.obj:1: the line is longer than 40 bytes");
  EXPECT_EQ(refused("f " + std::string(30, ' ') + "\\\n" + std::string(30, '1')),
            "t.obj:1: the joined line is longer than 40 bytes");
  EXPECT_EQ(refused(std::string(201, ' ')), "t.obj: is larger than 200 bytes");
}

TEST(Obj, WriterRefusesWhatContradictsItself) {
  const MeshFile good = parse_obj(kSquare + "vt 0 0\nf 1/1 2/1 3/1\n", "t.obj");
  const auto refused = [&](const std::function<void(MeshFile&)>& spoil) {
    MeshFile mesh = good;
    spoil(mesh);
    return message_of([&] { format_obj(mesh); });
  };
  EXPECT_EQ(refused([](MeshFile& m) { m.triangles[0][1] = 4; }), "OBJ: vertex 4 of 4");
  EXPECT_EQ(refused([](MeshFile& m) { m.vertices[0].x() = NAN; }), "OBJ: a vertex is not finite: nan");
  EXPECT_EQ(refused([](MeshFile& m) { m.haptic.resize(2); }), "OBJ: 2 haptic triangles where 1 are needed");
  EXPECT_EQ(refused([](MeshFile& m) { m.texture_corners[0][2] = kNoIndex; }),
            "OBJ: triangle 0 has an attribute at some corners only");
  EXPECT_THAT(refused([](MeshFile& m) {
                m.groups = {"a\nv 0 0 0"};
                m.parts = {{0, -1, 0, -1, 0}};
              }),
              HasSubstr("a name cannot be written: 'a\\x0av 0 0 0'"));
}

}  // namespace
}  // namespace asperity
