// A PLY is refused with an Error, or reads to a mesh whose geometry is written and read back exactly.
#include "asperity/base/error.h"
#include "asperity/geometry/read_ply.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/geometry/write_ply.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::MeshFile mesh;
  try {
    mesh = asperity::parse_ply(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::format_obj(mesh);
  const std::string bytes = asperity::format_ply(mesh);
  const asperity::MeshFile again = asperity::parse_ply(bytes, "again");
  asperity::must(again.vertices == mesh.vertices && again.triangles == mesh.triangles);
  return 0;
}
