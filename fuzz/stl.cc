// An STL is refused with an Error, or reads to a mesh in which every index exists.
#include "asperity/base/error.h"
#include "asperity/geometry/read_stl.h"
#include "asperity/geometry/write_stl.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::MeshFile mesh;
  try {
    mesh = asperity::parse_stl(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  for (const asperity::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) asperity::must(vertex < mesh.vertices.size());
  }
  try {
    const std::string bytes = asperity::format_stl(mesh);
    asperity::must(asperity::parse_stl(bytes, "again").triangles.size() == mesh.triangles.size());
  } catch (const asperity::Error&) {  // an ascii file may hold numbers beyond float32
  }
  return 0;
}
