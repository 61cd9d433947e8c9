#include "asperity/geometry/write_stl.h"

#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

void append_stl_vector(std::string& out, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) {
    const auto value = static_cast<float>(vector[i]);
    if (!std::isfinite(value)) throw Error("STL: " + number_text(vector[i]) + " cannot be written as float32");
    append_little_endian(out, value);
  }
}

}  // namespace

std::string format_stl(const MeshFile& mesh) {
  std::string out = "Asperity";
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  append_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangle[k] >= mesh.vertices.size())
        throw Error("STL: vertex " + std::to_string(triangle[k]) + " does not exist");
      corners[k] = mesh.vertices[triangle[k]];
    }
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).stableNormalized().cross((corners[2] - corners[0]).stableNormalized());
    append_stl_vector(out, normal.stableNormalized());
    for (const Eigen::Vector3d& corner : corners) append_stl_vector(out, corner);
    append_little_endian(out, std::uint16_t{0});
  }
  return out;
}

void write_stl(const std::filesystem::path& path, const MeshFile& mesh) { write_file(path, format_stl(mesh)); }

}  // namespace asperity
