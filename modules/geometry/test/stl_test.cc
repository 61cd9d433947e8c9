#include "asperity/geometry/read_stl.h"

#include <string>

#include <gmock/gmock.h>

#include "asperity/geometry/write_stl.h"
#include "mesh_format_rig.h"

namespace asperity {
namespace {

using test::message_of;
using test::pyramid;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

TEST(Stl, BinaryAndAsciiAreToldApart) {
  const MeshFile mesh = pyramid();
  std::string bytes = format_stl(mesh);
  ASSERT_EQ(bytes.size(), 84u + 50u * 6u);
  bytes.replace(0, 5, "solid");
  const MeshFile binary = parse_stl(bytes, "t.stl");
  EXPECT_EQ(binary.triangles.size(), 6u);
  EXPECT_EQ(binary.vertices.size(), 5u);
  EXPECT_EQ(binary.vertices[0], Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(binary.vertices[3], Eigen::Vector3d(0.1f, 0, 0));
  EXPECT_THAT(binary.problems, IsEmpty());
  const std::string rounded = format_stl(binary);  // normals of the rounded corners
  EXPECT_EQ(format_stl(parse_stl(rounded, "again")), rounded);

  const MeshFile ascii = parse_stl(
      "solid upper part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1e0 0 0\n   vertex -0 1 0\n  "
      "endloop\n"
      " endfacet\n FACET NORMAL 0 0 1\n outer loop\n vertex 0 0 0\n vertex 0 1 0\n vertex 1 0 0\n endloop\n "
      "endfacet\nendsolid upper part\n"
      "solid\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 "
      "0\nendloop\nendfacet\nendsolid\n",
      "t.stl");
  EXPECT_THAT(ascii.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 1}, Triangle{0, 0, 1}));
  EXPECT_THAT(ascii.objects, ElementsAre("upper part"));
  EXPECT_THAT(ascii.problems,
              ElementsAre(Field(&Problem::message, "t.stl:9: the normal points against the corners' order")));
}

TEST(Stl, RefusalsNameThePlace) {
  const auto refused = [](const std::string& text) { return message_of([&] { parse_stl(text, "t.stl"); }); };
  const std::string bytes = format_stl(pyramid());
  EXPECT_EQ(refused(bytes.substr(0, bytes.size() - 1)),
            "t.stl: is cut, or is not an STL: its header counts 6 triangles, 5 are in it");
  EXPECT_EQ(refused("nothing"), "t.stl: is not an STL: 7 bytes");
  EXPECT_EQ(refused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), "t.stl:4: '' is not a coordinate");
  EXPECT_EQ(refused("solid a\nendsolid a\n"), "t.stl: holds no triangles");
  EXPECT_EQ(parse_stl(bytes + "tail", "t.stl").problems.at(0).count, 4u);
  MeshFile huge = pyramid();
  huge.vertices[0].x() = 1e39;
  EXPECT_EQ(message_of([&] { format_stl(huge); }), "STL: 1e+39 cannot be written as float32");
}

}  // namespace
}  // namespace asperity
