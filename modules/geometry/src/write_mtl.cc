#include "asperity/geometry/write_mtl.h"

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/unique_material_names.h"

namespace asperity {

namespace {

void append_line(std::string& out, const char* keyword, const std::string& text) {
  if (text.empty()) return;
  const bool fits = text.find_first_of(std::string_view("\n\r\0", 3)) == std::string::npos && trim(text) == text &&
                    !text.ends_with('\\');
  if (!fits) throw Error("MTL: a name cannot be written: '" + printable(text) + "'");
  out += keyword;
  out += ' ';
  out += text;
  out += '\n';
}

}  // namespace

std::string format_mtl(std::span<const MeshMaterial> materials) {
  std::string out;
  const std::vector<std::string> names = unique_material_names(materials);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MeshMaterial& material = materials[i];
    if (material.name.empty()) throw Error("MTL: a material without a name");
    append_line(out, "newmtl", names[i]);
    if (material.base_colour) {
      if (!material.base_colour->allFinite())
        throw Error("MTL: the colour of '" + printable(material.name) + "' is not finite");
      out += "Kd";
      for (int c = 0; c < 3; ++c) {
        out += ' ';
        append_number(out, (*material.base_colour)[c]);
      }
      out += '\n';
    }
    append_line(out, "map_Kd", material.base_colour_map);
    append_line(out, "norm", material.normal_map);
    append_line(out, "bump", material.bump_map);
    append_line(out, "disp", material.displacement_map);
  }
  return out;
}

void write_mtl(const std::filesystem::path& path, std::span<const MeshMaterial> materials) {
  write_file(path, format_mtl(materials));
}

}  // namespace asperity
