#include "asperity/geometry/mesh_unit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cctype>
#include <string>

#include "asperity/base/text.h"

namespace asperity {

double size_of_mesh_m(const MeshFile& mesh, double unit_m) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box.isEmpty() ? 0.0 : box.diagonal().norm() * unit_m;
}

bool states_its_unit(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".json" || ending == ".glb" || ending == ".gltf";
}

bool is_likely_size(double size_m) {
  constexpr double kLargest_m = 5.0, kSmallest_m = 1e-3;
  return !(size_m > 0.0) || (size_m >= kSmallest_m && size_m <= kLargest_m);
}

void refuse_unlikely_metres(const MeshFile& mesh, const std::filesystem::path& file) {
  if (states_its_unit(file)) return;
  const double size_m = size_of_mesh_m(mesh, 1.0);
  if (is_likely_size(size_m)) return;
  const std::string name = printable(file.string(), 200);
  const std::string size = size_m < 1.0 ? fmt::format("{:.3g} mm", 1e3 * size_m) : fmt::format("{:.3g} m", size_m);
  throw UnlikelyMetres(name + ": the mesh is " + size + " large if its unit is a metre; state its unit", size_m);
}

}  // namespace asperity
