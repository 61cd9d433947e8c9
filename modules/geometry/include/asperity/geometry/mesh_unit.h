#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_file.h"

namespace asperity {

// Places and meshes in metres, where nobody could have taken another unit: what is further away or smaller is no object
// that is felt, and its squares would overflow or vanish on the way.
inline constexpr double kFurthestPlace_m = 1e6, kSmallestMesh_m = 1e-9;

// Nobody stated the unit of a mesh's file, and metres make it something that no hand scans. The message ends before
// how the unit is stated, which the caller knows.
class UnlikelyMetres : public Error {
 public:
  UnlikelyMetres(const std::string& text, double size_m) : Error(text), size_m_(size_m) {}
  double size_m() const { return size_m_; }  // of the mesh, if its unit is a metre

 private:
  double size_m_;
};

// The length of the diagonal of the box around a mesh, m.
double size_of_mesh_m(const MeshFile& mesh, double unit_m);

// Whether the format states the unit: scene.json and glTF do.
bool states_its_unit(const std::filesystem::path& file);

// Whether something of this size is likely to be scanned by hand: from 1 mm to 5 m; so is a mesh without a size.
bool is_likely_size(double size_m);

// Throws UnlikelyMetres for a file that does not state its unit and whose size in metres is not likely.
void refuse_unlikely_metres(const MeshFile& mesh, const std::filesystem::path& file);

}  // namespace asperity
