// An OFF is refused with an Error, or reads to a mesh in which every index exists and whose geometry is written as an
// OBJ and read back exactly.
#include "asperity/base/error.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/read_off.h"
#include "asperity/geometry/write_obj.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::MeshFile mesh;
  try {
    mesh = asperity::parse_off(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  for (const asperity::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) asperity::must(vertex < mesh.vertices.size());
  const asperity::MeshFile again = asperity::parse_obj(asperity::format_obj(mesh), "again");
  asperity::must(again.vertices == mesh.vertices && again.triangles == mesh.triangles);
  return 0;
}
