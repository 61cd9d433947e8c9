// A scene.json: what is read names its file when it is refused, and holds files inside the scene's folder alone.
#include "asperity/base/error.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/write_scene.h"
#include "fuzz_input.h"
#include "parse_scene.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Scene scene = parse_scene(fuzz_text(data, size), "scene.json");
    must(!scene.objects.empty());
    for (const SceneObject& object : scene.objects) {
      must(stays_inside(object.mesh_file));
      for (const SceneTexture& texture : object.textures) must(stays_inside(texture.file));
    }
    const std::string written = format_scene(scene);
    must(format_scene(parse_scene(written, "again.json")) == written);
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("scene.json:"));
  }
  return 0;
}
