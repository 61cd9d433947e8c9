// Files of tinyobjloader's test suite (MIT, see data/obj/tinyobjloader/LICENSE). Triangles are corners less
// two summed over the file's faces, counted apart from the reader.
#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/write_obj.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

const std::filesystem::path kData = std::filesystem::path(ASPERITY_TEST_DATA) / "obj" / "tinyobjloader";

const MeshMaterial& material(const MeshFile& mesh, const std::string& name) {
  for (const MeshMaterial& m : mesh.materials) {
    if (m.name == name) return m;
  }
  throw Error("no material " + name);
}

TEST(ObjTorture, LoadsTheTrianglesThatTheFilesHold) {
  const std::vector<std::pair<const char*, std::pair<std::size_t, std::size_t>>> expected{
      {"cornell_box.obj", {76, 36}},
      {"cube-vertexcol.obj", {8, 12}},
      {"cube-vertex-w-component.obj", {8, 12}},
      {"issue-295-trianguation-failure.obj", {16, 28}},
      {"issue-319-002.obj", {20, 14}},
      {"issue-319-003.obj", {10, 8}},
      {"issue-330.obj", {7, 3}},
      {"leading-zero-in-exponent-notation-issue-210.obj", {3, 1}},
      {"mtl filename with whitespace issue46.obj", {8, 12}},
      {"skin-weight.obj", {8, 12}},
      {"texture-options-issue-85.obj", {3, 1}},
      {"usemtl-issue-104.obj", {12, 6}}};
  for (const auto& [file, counts] : expected) {
    const MeshFile mesh = read_mesh(kData / file);
    EXPECT_EQ(mesh.vertices.size(), counts.first) << file;
    EXPECT_EQ(mesh.triangles.size(), counts.second) << file;
    const std::string text = format_obj(mesh);
    EXPECT_EQ(format_obj(parse_obj(text, file)), text) << file;
  }
}

TEST(ObjTorture, RefusesWithThePlace) {
  const std::vector<std::pair<const char*, const char*>> expected{
      {"catmark_torus_creases0.obj", "catmark_torus_creases0.obj:62: '5/1/1' names normal 1, 0 are defined so far"},
      {"invalid-face-definition.obj", "invalid-face-definition.obj:15: a face of 1 corners"},
      {"invalid-relative-vertex-index.obj", "invalid-relative-vertex-index.obj:1: '-4' names vertex -4"},
      {"issue-140-zero-face-idx.obj", "issue-140-zero-face-idx.obj:16: '0/0/0' has index 0"},
      {"test-nan.obj", "test-nan.obj:12: 'nan' is not a finite number"}};
  for (const auto& [file, message] : expected) {
    try {
      read_mesh(kData / file);
      ADD_FAILURE() << file << " was read";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  }
}

TEST(ObjTorture, LibrariesAreFoundAndWhatIsMissingIsReported) {
  const MeshFile box = read_mesh(kData / "cornell_box.obj");
  EXPECT_EQ(material(box, "red").base_colour, Eigen::Vector3d(1, 0, 0));
  const MeshFile blanks = read_mesh(kData / "mtl filename with whitespace issue46.obj");
  EXPECT_EQ(material(blanks, "green").base_colour, Eigen::Vector3d(0, 1, 0));
  EXPECT_THAT(blanks.problems,
              Contains(Field(&Problem::message, HasSubstr("'invalid-file-without-spaces.mtl' is missing"))));
  const MeshFile several = read_mesh(kData / "mtllib-multiple-files-issue-112.obj");
  EXPECT_EQ(material(several, "default").base_colour_map, "tmp.png");
  const MeshFile names = read_mesh(kData / "texture-filename-with-whitespace.obj");
  EXPECT_EQ(material(names, "white").base_colour_map, "texture 01.png");
  EXPECT_EQ(material(names, "red").bump_map, "bump 01.png");
  const MeshFile options = read_mesh(kData / "texture-options-issue-85.obj");
  EXPECT_EQ(material(options, "default").base_colour_map, "diffuse.jpg");
  EXPECT_EQ(material(options, "bm2").bump_map, "bumpmap2.jpg");
  EXPECT_EQ(material(options, "bm3").displacement_map, "displacement.jpg");
}

}  // namespace
}  // namespace asperity
