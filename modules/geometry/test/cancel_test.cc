// Readers and trees of large meshes end when the observer says so.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/read_off.h"
#include "asperity/geometry/read_ply.h"
#include "asperity/geometry/read_stl.h"

namespace asperity {
namespace {

constexpr std::uint32_t kSide = 200;  // 79,202 triangles: of leaves and lines there are more than an observer waits for

TriangleMesh waves() {
  TriangleMesh out;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const auto x = static_cast<double>(i % kSide), y = static_cast<double>(i / kSide);
    out.vertices_m.emplace_back(x, y, std::sin(x) * std::cos(y));
  }
  for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
    for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
      const std::uint32_t at = row * kSide + column;
      out.triangles.push_back({at, at + 1, at + kSide + 1});
      out.triangles.push_back({at, at + kSide + 1, at + kSide});
    }
  }
  return out;
}

std::string rows(const char* before_vertex, const char* before_face, std::uint32_t first) {
  const TriangleMesh mesh = waves();
  std::string out;
  for (const Eigen::Vector3d& v : mesh.vertices_m)
    out += before_vertex + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
  for (const Triangle& t : mesh.triangles) {
    out += before_face + std::to_string(t[0] + first) + " " + std::to_string(t[1] + first) + " " +
           std::to_string(t[2] + first) + "\n";
  }
  return out;
}

std::string counts() { return std::to_string(kSide * kSide) + " " + std::to_string(2 * (kSide - 1) * (kSide - 1)); }

const Observer kStop{{}, [] { return true; }};

TEST(Cancel, ATreeIsNotFinished) {
  EXPECT_THROW(MeshBvh(waves(), kStop), Cancelled);
  EXPECT_TRUE(MeshBvh(waves()).closest_point({1.0, 1.0, 1.0}).found());
}

TEST(Cancel, AFileIsNotReadToItsEnd) {
  const std::string obj = rows("v ", "f ", 1), off = "OFF\n" + counts() + " 0\n" + rows("", "3 ", 0);
  EXPECT_THROW(parse_obj(obj, "x.obj", {}, kStop), Cancelled);
  EXPECT_THROW(parse_off(off, "x.off", {}, kStop), Cancelled);
  EXPECT_EQ(parse_obj(obj, "x.obj").triangles, waves().triangles);
  EXPECT_EQ(parse_off(off, "x.off").triangles, waves().triangles);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 40000\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 79202\nproperty list uchar int vertex_indices\nend_header\n" +
      rows("", "3 ", 0);
  EXPECT_THROW(parse_ply(ply, "x.ply", {}, kStop), Cancelled);
  EXPECT_EQ(parse_ply(ply, "x.ply").triangles, waves().triangles);
  std::string stl(84, ' ');
  const std::uint32_t facets = 10000;
  for (int k = 0; k < 4; ++k) stl[80 + static_cast<std::size_t>(k)] = static_cast<char>(facets >> (8 * k) & 0xFFU);
  stl.append(50 * facets, '\0');
  EXPECT_THROW(parse_stl(stl, "x.stl", {}, kStop), Cancelled);
  EXPECT_EQ(parse_stl(stl, "x.stl").triangles.size(), facets);
}

}  // namespace
}  // namespace asperity
