#include "asperity/geometry/read_mesh.h"

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_gltf.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/read_off.h"
#include "asperity/geometry/read_ply.h"
#include "asperity/geometry/read_stl.h"

namespace asperity {

MeshFile read_mesh(const std::filesystem::path& path, const MeshLimits& limits, const Observer& observer) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (std::filesystem::is_directory(path)) throw Error(path.string() + ": is a folder, not a mesh");
  if (extension.empty())
    throw Error(path.string() +
                ": has no ending that states the kind of mesh; .obj, .ply, .stl, .off, .gltf and .glb can be read");
  if (extension == ".obj") return read_obj(path, limits, observer);
  if (extension == ".ply") return read_ply(path, limits, observer);
  if (extension == ".stl") return read_stl(path, limits, observer);
  if (extension == ".off") return read_off(path, limits, observer);
  if (extension == ".gltf" || extension == ".glb") return read_gltf(path, limits, observer);
  throw Error(path.string() + ": '" + printable(extension) +
              "' is not a mesh that can be read; .obj, .ply, .stl, .off, .gltf and .glb are");
}

}  // namespace asperity
