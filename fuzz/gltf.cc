// A glTF is refused with an Error, or reads to a mesh that an OBJ can hold.
#include "asperity/base/error.h"
#include "asperity/geometry/read_gltf.h"
#include "asperity/geometry/write_obj.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::MeshFile mesh;
  try {
    mesh = asperity::parse_gltf(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  const std::string text = asperity::format_obj(mesh);
  asperity::must(!text.empty());
  return 0;
}
