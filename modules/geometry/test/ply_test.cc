#include "asperity/geometry/read_ply.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/geometry/write_ply.h"
#include "mesh_format_rig.h"

namespace asperity {
namespace {

using test::append_value;
using test::message_of;
using test::pyramid;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Ply, AsciiWithEverything) {
  const MeshFile mesh = parse_ply(
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty float y\nproperty "
      "int z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float "
      "nx\nproperty float ny\n"
      "property float nz\nproperty float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property float quality\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
      "0.1 0 0 255 0 51 9 0 0 1 0 .5\n1 0 0 255 0 0 9 0 0 1 1 0\n1 1 0 255 0 0 9 0 0 1 1 1\n0 1 0 255 0 0 9 0 0 1 0 1\n"
      "4 0 1 2 3 0.5\n3 0 0 2 0.5\n1 2\n",
      "t.ply");
  EXPECT_EQ(mesh.vertices[0], Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(mesh.vertex_colours[0], Eigen::Vector3d(1, 0, 0.2));
  EXPECT_EQ(mesh.texture_coordinates[0], Eigen::Vector3d(0, 0.5, 0));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 0, 2}));
  EXPECT_EQ(mesh.normal_corners, mesh.triangles);
  std::vector<std::string> kinds;
  for (const Problem& p : mesh.problems) kinds.push_back(p.message);
  EXPECT_THAT(
      kinds,
      ElementsAre("t.ply: property 'alpha' of 'vertex' is not read", "t.ply: property 'quality' of 'face' is not read",
                  "t.ply: face 1 (from 0) has the same vertex twice", "t.ply: element 'edge' is not read"));
}

TEST(Ply, BothByteOrdersAndOddTypes) {
  for (const bool big : {false, true}) {
    std::string file =
        std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\r\nelement vertex 4\r\nproperty list uchar short junk\r\nproperty double x\r\nproperty short y\r\n"
        "property float z\r\nelement face 1\r\nproperty list ushort uchar vertex_index\r\nend_header\r\n";
    const double x[4] = {0, 1, 1, 0};
    const short y[4] = {0, 0, -7, -7};
    for (int i = 0; i < 4; ++i) {
      append_value(file, static_cast<unsigned char>(2), big);
      append_value(file, short{1}, big);
      append_value(file, short{2}, big);
      append_value(file, x[i] / 3, big);
      append_value(file, y[i], big);
      append_value(file, 0.5f, big);
    }
    append_value(file, static_cast<unsigned short>(4), big);
    file += std::string("\0\1\2\3", 4);
    const MeshFile mesh = parse_ply(file, "t.ply");
    EXPECT_THAT(mesh.vertices, ElementsAre(Eigen::Vector3d(0, 0, .5), Eigen::Vector3d(1.0 / 3, 0, .5),
                                           Eigen::Vector3d(1.0 / 3, -7, .5), Eigen::Vector3d(0, -7, .5)));
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_THAT(message_of([&] { parse_ply(file.substr(0, file.size() - 1), "t.ply"); }),
                HasSubstr("face 0 (from 0): the file is cut here"));
    EXPECT_EQ(parse_ply(file + "xx", "t.ply").problems.back().message, "t.ply: bytes after the last element");
  }
}

TEST(Ply, WritesDoublesExactly) {
  MeshFile mesh = pyramid();
  mesh.vertex_colours.assign(mesh.vertices.size(), Eigen::Vector3d(0.1, 0.2, 0.3));
  const std::string bytes = format_ply(mesh);
  const MeshFile again = parse_ply(bytes, "again");
  EXPECT_EQ(again.vertices, mesh.vertices);
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.vertex_colours, mesh.vertex_colours);
  EXPECT_THAT(again.problems, IsEmpty());
  EXPECT_EQ(format_ply(again), bytes);
}

TEST(Ply, RefusalsNameThePlace) {
  const auto refused = [](const std::string& text) { return message_of([&] { parse_ply(text, "t.ply"); }); };
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(refused("plx\n"), "t.ply:1: is not a PLY: it does not begin with 'ply'");
  EXPECT_EQ(refused("ply\nformat ascii 2.0\n"),
            "t.ply:2: 'format ascii|binary_little_endian|binary_big_endian 1.0' is needed");
  EXPECT_EQ(refused(head + "property half w\n"), "t.ply:7: type 'half' is not known");
  EXPECT_EQ(refused(head), "t.ply:7: the header has no 'end_header'");
  EXPECT_EQ(refused(head + faces + "0 0 0 1 0 0 1 x 0 3 0 1 2"), "t.ply: vertex 2 (from 0): 'x' is not a number");
  EXPECT_EQ(refused(head + faces + "0 0 0 1 0 0 1 nan 0 3 0 1 2"), "t.ply: vertex 2 (from 0): 'y' is nan");
  EXPECT_EQ(refused(head + faces + "0 0 0 1 0 0 1 1 0 3 0 1 3"), "t.ply: face 0 (from 0): vertex 3 of 3");
  EXPECT_EQ(refused(head + faces + "0 0 0 1 0 0 1 1 0 3 0 1 -1"), "t.ply: face 0 (from 0): vertex -1 of 3");
  EXPECT_THAT(refused("ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n0"),
              HasSubstr("is cut"));
}

// Two strips: a fan of three triangles and a single one; every second is turned, so that all look the same way.
TEST(Ply, StripsOfTriangles) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n";
  const MeshFile mesh = parse_ply(head + "9 1 0 3 2 4 -1 0 2 3\n", "m.ply", {});
  ASSERT_EQ(mesh.triangles.size(), 4u);
  const auto normal_z = [&](const Triangle& t) {
    return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).z();
  };
  for (const Triangle& triangle : mesh.triangles) EXPECT_GT(normal_z(triangle), 0.0);
  EXPECT_TRUE(mesh.problems.empty());
  EXPECT_THROW(parse_ply(head + "4 0 1 2 5\n", "m.ply", {}), Error);
  EXPECT_THROW(parse_ply(head + "4 0 1 2 -2\n", "m.ply", {}), Error);
  EXPECT_THROW(parse_ply(head + "9 0 1 2\n", "m.ply", {}), Error);
}

}  // namespace
}  // namespace asperity
