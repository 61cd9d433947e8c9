#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <unistd.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/geometry/read_gltf.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/geometry/read_mtl.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/read_ply.h"
#include "asperity/geometry/read_stl.h"
#include "asperity/geometry/write_gltf.h"
#include "asperity/geometry/write_mtl.h"
#include "asperity/geometry/write_ply.h"
#include "asperity/geometry/write_stl.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

template <class Number>
void append(std::string& out, Number value, bool big) {
  std::string bytes(reinterpret_cast<const char*>(&value),
                    sizeof value);  // the machines we build for are little-endian
  if (big) bytes.assign(bytes.rbegin(), bytes.rend());
  out += bytes;
}

MeshFile pyramid() {
  return parse_obj(
      "v 0.1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0.3333333333333333\n"
      "f 4 3 2\nf 4 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n",
      "pyramid");
}

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
      append(file, static_cast<unsigned char>(2), big);
      append(file, short{1}, big);
      append(file, short{2}, big);
      append(file, x[i] / 3, big);
      append(file, y[i], big);
      append(file, 0.5f, big);
    }
    append(file, static_cast<unsigned short>(4), big);
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
            "t.stl: is cut or no STL: its header counts 6 triangles, 5 are in it");
  EXPECT_EQ(refused("nothing"), "t.stl: is not an STL: 7 bytes");
  EXPECT_EQ(refused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), "t.stl:4: '' is not a coordinate");
  EXPECT_EQ(refused("solid a\nendsolid a\n"), "t.stl: holds no triangles");
  EXPECT_EQ(parse_stl(bytes + "tail", "t.stl").problems.at(0).count, 4u);
  MeshFile huge = pyramid();
  huge.vertices[0].x() = 1e39;
  EXPECT_EQ(message_of([&] { format_stl(huge); }), "STL: 1e+39 cannot be written as float32");
}

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

GltfExport example() {
  GltfExport scene;
  scene.mesh = pyramid();
  scene.mesh.materials.resize(1);
  scene.mesh.materials[0] = {"clay", Eigen::Vector3d(0.5, 0.25, 0.125), "colour.png", "", "", ""};
  scene.mesh.parts = {{0, -1, -1, 0, 0}};
  scene.mesh.haptic.resize(6);
  for (std::size_t i = 2; i < 6; ++i) {
    scene.mesh.haptic[i].texture = 7;
    scene.mesh.haptic[i].xy_mm = {Eigen::Vector2d(0, 0), Eigen::Vector2d(12.5, -3), Eigen::Vector2d(double(i), 1)};
  }
  scene.unit_m = 0.001;
  GltfTexture texture;
  texture.index = 7;
  texture.name = "grooves";
  texture.size_mm = {10, 20};
  texture.normal_map = GltfImage{"normals", "\x89PNG normal", ""};
  texture.height_map = GltfImage{"heights", "", "heights.png"};
  texture.height_range_m = 0.0025;
  texture.friction = 0.4;
  scene.textures.push_back(texture);
  return scene;
}

// Geometry and haptic coordinates come back but for float32: 2^-24 of each number.
TEST(Gltf, ReadsBackWhatItWrote) {
  const GltfExport scene = example();
  for (const GltfForm form : {GltfForm::kJson, GltfForm::kBinary}) {
    const std::string bytes = format_gltf(scene, form);
    const MeshFile mesh = parse_gltf(bytes, "t.glb");
    ASSERT_EQ(mesh.triangles.size(), 6u);
    ASSERT_EQ(mesh.vertices.size(), 5u);
    ASSERT_EQ(mesh.haptic.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(mesh.haptic[i].texture, scene.mesh.haptic[i].texture);
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d expected = scene.mesh.vertices[scene.mesh.triangles[i][k]] * 0.001;
        EXPECT_LE((mesh.vertices[mesh.triangles[i][k]] - expected).cwiseAbs().maxCoeff(), 0x1p-24 * 0.001);
        if (scene.mesh.haptic[i].texture < 0) continue;
        EXPECT_LE((mesh.haptic[i].xy_mm[k] - scene.mesh.haptic[i].xy_mm[k]).cwiseAbs().maxCoeff(), 0x1p-23 * 12.5);
      }
    }
    EXPECT_THAT(mesh.texture_coordinates, IsEmpty());
    EXPECT_EQ(mesh.materials.at(0).base_colour_map, "colour.png");
    EXPECT_EQ(mesh.materials.at(0).base_colour, Eigen::Vector3d(0.5, 0.25, 0.125));
    EXPECT_EQ(format_gltf(scene, form), bytes);
  }
  const std::string json = format_gltf(scene, GltfForm::kJson);
  EXPECT_THAT(json, HasSubstr("\"vibrotactileTexture\""));
  EXPECT_THAT(json, HasSubstr("\"hapticMaterialIndex\": 0"));
  EXPECT_THAT(json, HasSubstr("\"height_range_m\": 0.0025"));
  EXPECT_THAT(json, HasSubstr("\"heights.png\""));
}

TEST(Gltf, TextureCoordinatesAndNormalsAreOfCorners) {
  GltfExport scene;
  scene.mesh = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 1 1\nvt 0.5 0.75\nvn 0 0 2\nf 1/1/1 2/2/1 3/3/1\nf "
      "1/4/1 3/3/1 4/2/1\n",
      "square");
  const MeshFile mesh = parse_gltf(format_gltf(scene, GltfForm::kBinary), "t.glb");
  ASSERT_EQ(mesh.vertices.size(), 4u);  // the corner at the origin has two texture coordinates, one place
  ASSERT_EQ(mesh.texture_corners.size(), 2u);
  EXPECT_EQ(mesh.texture_coordinates.at(mesh.texture_corners[0][0]), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(mesh.texture_coordinates.at(mesh.texture_corners[1][0]), Eigen::Vector3d(0.5, 0.75, 0));
  EXPECT_EQ(mesh.normals.at(mesh.normal_corners[1][2]), Eigen::Vector3d(0, 0, 1));
}

// One triangle strip of four corners in a buffer beside the file, placed twice, once mirrored.
class GltfFolder : public testing::Test {
 protected:
  GltfFolder() : folder_(fs::temp_directory_path() / ("asperity-gltf-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "in" / "side");
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) append(data_, value, false);
    for (const unsigned char i : {0, 1, 2, 3}) append(data_, i, false);
  }
  ~GltfFolder() override { fs::remove_all(folder_); }

  static std::string document(const std::string& uri, const std::string& mode, const std::string& nodes,
                              const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" + mode +
           R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}],
             "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":4}],"buffers":[{"byteLength":52,"uri":")" +
           uri + "\"}]" + more + "}";
  }
  std::string read(const std::string& text) {
    write_file(folder_ / "in" / "t.gltf", text);
    return message_of([&] { mesh_ = read_mesh(folder_ / "in" / "t.gltf"); });
  }

  fs::path folder_;
  std::string data_;
  MeshFile mesh_;
};

TEST_F(GltfFolder, NodesStripsFansAndMirrors) {
  write_file(folder_ / "in" / "side" / "a b.bin", data_);
  const std::string nodes =
      R"([{"translation":[10,0,0],"children":[1,2]},{"mesh":0,"name":"plain"},{"mesh":0,"scale":[-2,1,1],"rotation":[0,0,0,1]}])";
  ASSERT_EQ(read(document("side/a%20b.bin", "5", nodes)), "no error");
  EXPECT_THAT(mesh_.objects, ElementsAre("plain"));
  ASSERT_EQ(mesh_.triangles.size(), 4u);
  ASSERT_EQ(mesh_.vertices.size(), 6u);  // the two share an edge
  const auto at = [&](std::size_t t, std::size_t k) { return mesh_.vertices[mesh_.triangles[t][k]]; };
  for (std::size_t t = 0; t < 4; ++t) {  // the mirrored square still faces up
    EXPECT_GT((at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)).z(), 0.0) << t;
  }
  EXPECT_EQ(at(2, 0), Eigen::Vector3d(10, 0, 0));
  ASSERT_EQ(read(document("side/a%20b.bin", "6", R"([{"mesh":0}])")), "no error");
  EXPECT_THAT(mesh_.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_F(GltfFolder, HostileFilesAreRefused) {
  write_file(folder_ / "in" / "d.bin", data_);
  write_file(folder_ / "secret.bin", data_);
  fs::create_symlink(folder_ / "secret.bin", folder_ / "in" / "link.bin");
  const std::string node = R"([{"mesh":0}])";
  EXPECT_EQ(read(document("d.bin", "5", node)), "no error");
  EXPECT_THAT(read(document("../secret.bin", "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document("link.bin", "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document((folder_ / "secret.bin").string(), "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document("d.bin", "4", node)), HasSubstr("4 corners are no triangles"));
  EXPECT_THAT(read(document("d.bin", "0", node)), HasSubstr("holds no triangles"));
  EXPECT_THAT(read(document("d.bin", "5", R"([{"children":[0],"mesh":0}])")), HasSubstr("its own ancestor"));
  EXPECT_THAT(read(document("d.bin", "5", R"([{"mesh":3}])")), HasSubstr("mesh 3 does not exist"));
  EXPECT_THAT(read(document("d.bin", "5", node, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])")),
              HasSubstr("KHR_draco_mesh_compression"));
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = document("d.bin", "5", node);
    text.replace(text.find(from), from.size(), to);
    return read(text);
  };
  EXPECT_THAT(spoilt("\"count\":4", "\"count\":5"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"count\":4", "\"count\":18446744073709551615"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"byteOffset\":48", "\"byteOffset\":49"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"bufferView\":1", "\"bufferView\":2"), HasSubstr("buffer"));
  EXPECT_THAT(spoilt("\"version\":\"2.0\"", "\"version\":\"1.0\""), HasSubstr("is glTF of version '1.0'"));
  data_[48] = 9;
  write_file(folder_ / "in" / "d.bin", data_);
  EXPECT_THAT(read(document("d.bin", "5", node)), HasSubstr("index 9 of 4 vertices"));
  EXPECT_THAT(read(std::string(10000, '[')), HasSubstr("deep"));
  const std::string glb = format_gltf(example(), GltfForm::kBinary);
  EXPECT_THAT(message_of([&] { parse_gltf(glb.substr(0, glb.size() - 1), "t.glb"); }), HasSubstr("is cut"));
}

TEST_F(GltfFolder, ObjLibrariesStayInTheFolder) {
  write_file(folder_ / "outside.mtl", "newmtl a\nKd 1 0 0\n");
  write_file(folder_ / "in" / "t.obj", "mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const MeshFile mesh = read_mesh(folder_ / "in" / "t.obj");
  EXPECT_FALSE(mesh.materials.at(0).base_colour);
  EXPECT_THAT(mesh.problems, Contains(Field(&Problem::kind, "outside_path")));
  EXPECT_THAT(message_of([&] { read_mesh(folder_ / "in" / "t.off"); }),
              HasSubstr("'.off' is not a mesh that can be read"));
}

}  // namespace
}  // namespace asperity
