#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/geometry/read_off.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// A cube of squares, by the format's description.
constexpr const char* kCube =
    "OFF\n# a cube\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

TEST(ReadOff, ACubeHasItsVolume) {
  const MeshFile mesh = parse_off(kCube, "cube.off");
  ASSERT_EQ(mesh.vertices.size(), 8u);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(mesh.problems.empty());
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles)
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(ReadOff, TakesTheFormsOfTheHeader) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string head : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "3 1 0\n", "OFF # x\n\n3 1\n"})
    EXPECT_EQ(parse_off(head + body, "t.off").triangles.size(), 1u) << head;
  for (const std::string head : {"NOFF\n3 1 0\n", "OFF BINARY\n3 1 0\n", "4OFF\n3 1 0\n"})
    EXPECT_THROW(parse_off(head + body, "t.off"), Error) << head;
}

TEST(ReadOff, KeepsColoursOfVertices) {
  const MeshFile bytes =
      parse_off("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 51 0 255 255\n3 0 1 2\n", "c.off");
  ASSERT_EQ(bytes.vertex_colours.size(), 3u);
  EXPECT_NEAR(bytes.vertex_colours[2].x(), 0.2, 1e-12);
  const MeshFile parts = parse_off("COFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0.2 0 1\n3 0 1 2 1 0 0\n", "c.off");
  EXPECT_EQ(parts.vertex_colours[2].x(), 0.2);
  ASSERT_EQ(parts.problems.size(), 1u);
  EXPECT_EQ(parts.problems[0].kind, "face_colour");
}

TEST(ReadOff, NamesLineAndValueOfWhatIsWrong) {
  const auto refuses = [](const std::string& text, const char* part) {
    EXPECT_THAT([&] { parse_off(text, "x.off"); }, ThrowsMessage<Error>(HasSubstr(part))) << text;
  };
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 y 0\n3 0 1 2\n", "x.off:5");
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "vertex 3 of 3");
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "ends before face 1 of 1");
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "2 corners");
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "after the last face");
  refuses("OFF\n400000000 1 0\n", "vertices");
  refuses("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces");
  refuses("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e300 0\n3 0 1 2\n", "1e12");
  // Cut at every byte: an error or, at the end of the last face, the mesh.
  const std::string whole = kCube;
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_THROW(parse_off(whole.substr(0, size), "cut.off"), Error) << size;
}

TEST(ReadOff, IsAMeshLikeOthers) {
  testkit::TempDir dir;
  write_file(dir / "cube.OFF", kCube);
  EXPECT_EQ(read_mesh(dir / "cube.OFF").triangles.size(), 12u);
}

}  // namespace
}  // namespace asperity
