#include "asperity/geometry/read_mtl.h"

#include <array>
#include <filesystem>

#include <gmock/gmock.h>

#include "asperity/base/output.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/geometry/write_mtl.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/testkit/temp_dir.h"
#include "mesh_format_rig.h"

namespace asperity {
namespace {

using test::message_of;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

TEST(Mtl, KeepsColourAndMapsAndReportsTheRest) {
  const MaterialLibrary library = parse_mtl(
      "Kd 1 1 1\nnewmtl red clay\nKa 0 0 0\nKd 1 0.5 .25\nmap_Kd -s 1 1 1 a b.png\nnorm -bm 2 n.png\nbump b.png -bm "
      "3\ndisp d/e.png\n"
      "newmtl other\nmap_Kd ../../secret.png\nbump /etc/passwd\nKd red\n",
      "t.mtl");
  ASSERT_EQ(library.materials.size(), 2u);
  const MeshMaterial& m = library.materials[0];
  EXPECT_EQ(m.base_colour, Eigen::Vector3d(1, 0.5, 0.25));
  EXPECT_EQ(m.base_colour_map, "a b.png");
  EXPECT_EQ(m.normal_map, "n.png");
  EXPECT_EQ(m.bump_map, "b.png");
  EXPECT_EQ(m.displacement_map, "d/e.png");
  EXPECT_EQ(library.materials[1].base_colour_map, "");
  EXPECT_THAT(library.problems,
              Contains(testing::AllOf(Field(&Problem::kind, "outside_path"), Field(&Problem::count, 2u))));
  EXPECT_THAT(library.problems,
              Contains(testing::AllOf(Field(&Problem::kind, "material_line"), Field(&Problem::count, 2u))));
  const MaterialLibrary again = parse_mtl(format_mtl(library.materials), "again");
  EXPECT_EQ(format_mtl(again.materials), format_mtl(library.materials));
}

TEST(Mtl, TwoMaterialsOfOneNameStayTwo) {
  MeshFile mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 3, 2}, {0, 1, 3}};
  const std::array<const char*, 4> names{"clay", "clay", "clay_2", "clay"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    MeshMaterial& material = mesh.materials.emplace_back();
    material.name = names[i];
    material.base_colour = Eigen::Vector3d::Constant(0.125 * static_cast<double>(i));
    MeshPart& part = mesh.parts.emplace_back();
    part.first_triangle = static_cast<std::uint32_t>(i);
    part.material = static_cast<std::int32_t>(i);
  }
  mesh.material_libraries = {"t.mtl"};
  const testkit::TempDir folder;
  write_file(folder / "t.mtl", format_mtl(mesh.materials));
  write_file(folder / "t.obj", format_obj(mesh));
  const MeshFile again = read_mesh(folder / "t.obj");
  ASSERT_EQ(again.parts.size(), 4u);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const MeshMaterial& material = again.materials.at(static_cast<std::size_t>(again.parts[i].material));
    EXPECT_EQ(material.base_colour, mesh.materials[i].base_colour) << i;
  }
}

TEST(Mtl, LibrariesStayInTheFolder) {
  const testkit::TempDir folder;
  std::filesystem::create_directory(folder / "in");
  write_file(folder / "outside.mtl", "newmtl a\nKd 1 0 0\n");
  write_file(folder / "in" / "t.obj", "mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const MeshFile mesh = read_mesh(folder / "in" / "t.obj");
  EXPECT_FALSE(mesh.materials.at(0).base_colour);
  EXPECT_THAT(mesh.problems, Contains(Field(&Problem::kind, "outside_path")));
  EXPECT_THAT(message_of([&] { read_mesh(folder / "in" / "t.3ds"); }),
              HasSubstr("'.3ds' is not a mesh that can be read"));
}

}  // namespace
}  // namespace asperity
