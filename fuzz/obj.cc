// An OBJ is refused with an Error, or reads to a mesh that is written and read back to the same bytes.
#include "asperity/base/error.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/write_obj.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::MeshFile mesh;
  try {
    mesh = asperity::parse_obj(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::must(mesh.haptic.empty() || mesh.haptic.size() == mesh.triangles.size());
  const std::string text = asperity::format_obj(mesh);
  asperity::must(asperity::format_obj(asperity::parse_obj(text, "again")) == text);
  return 0;
}
