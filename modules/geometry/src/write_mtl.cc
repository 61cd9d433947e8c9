#include "asperity/geometry/write_mtl.h"

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"

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
  for (const MeshMaterial& material : materials) {
    if (material.name.empty()) throw Error("MTL: a material without a name");
    append_line(out, "newmtl", material.name);
    if (material.base_colour) {
      if (!material.base_colour->allFinite())
        throw Error("MTL: the colour of '" + printable(material.name) + "' is not finite");
      out += "Kd";
      for (int i = 0; i < 3; ++i) {
        out += ' ';
        append_number(out, (*material.base_colour)[i]);
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
