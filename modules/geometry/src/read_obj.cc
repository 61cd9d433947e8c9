#include "asperity/geometry/read_obj.h"

#include "asperity/base/csv.h"

namespace asperity {

MeshFile read_obj(const std::filesystem::path& path, const MeshLimits& limits) {
  return parse_obj(read_file(path, limits.file_bytes), path.string(), limits);
}

}  // namespace asperity
