#include "asperity/geometry/write_ply.h"

#include <algorithm>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/output.h"

namespace asperity {

namespace {

void append_ply_vector(std::string& out, const Eigen::Vector3d& vector) {
  if (!vector.allFinite()) throw Error("PLY: a number of a vertex is not finite");
  for (int i = 0; i < 3; ++i) append_little_endian(out, vector[i]);
}

}  // namespace

std::string format_ply(const MeshFile& mesh) {
  const bool colours = !mesh.vertex_colours.empty() && mesh.vertex_colours.size() == mesh.vertices.size() &&
                       std::all_of(mesh.vertex_colours.begin(), mesh.vertex_colours.end(),
                                   [](const Eigen::Vector3d& colour) { return colour.allFinite(); });
  std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\n";
  if (colours) out += "property double red\nproperty double green\nproperty double blue\n";
  out += "element face " + std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
  out.reserve(out.size() + (colours ? 48 : 24) * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    append_ply_vector(out, mesh.vertices[i]);
    if (colours) append_ply_vector(out, mesh.vertex_colours[i]);
  }
  for (const Triangle& triangle : mesh.triangles) {
    out += '\3';
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= mesh.vertices.size()) throw Error("PLY: vertex " + std::to_string(vertex) + " does not exist");
      append_little_endian(out, vertex);
    }
  }
  return out;
}

void write_ply(const std::filesystem::path& path, const MeshFile& mesh) { write_file(path, format_ply(mesh)); }

}  // namespace asperity
