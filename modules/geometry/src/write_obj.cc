#include "asperity/geometry/write_obj.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/unique_material_names.h"

namespace asperity {

namespace {

[[noreturn]] void refuse_obj(const std::string& message) { throw Error("OBJ: " + message); }

void append_finite(std::string& out, double value, const char* what) {
  if (!std::isfinite(value)) refuse_obj(std::string(what) + " is not finite: " + number_text(value));
  append_number(out, value);
}

// With a decimal point, as the seed prints the coordinates in Fig. 33.
void append_decimal(std::string& out, double value) {
  const std::size_t begin = out.size();
  append_finite(out, value, "a haptic coordinate");
  if (out.find_first_of(".e", begin) == std::string::npos) out += ".0";
}

void append_numbers(std::string& out, const Eigen::Vector3d& vector, const char* what) {
  for (int i = 0; i < 3; ++i) {
    out += ' ';
    append_finite(out, vector[i], what);
  }
}

void append_vertices(std::string& out, const MeshFile& mesh) {
  out += "## vertices\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    out += 'v';
    append_numbers(out, mesh.vertices[i], "a vertex");
    const bool has_w = !mesh.vertex_w.empty() && !std::isnan(mesh.vertex_w[i]);
    const bool has_colour = !mesh.vertex_colours.empty() && !std::isnan(mesh.vertex_colours[i][0]);
    if (has_w && has_colour) refuse_obj("vertex " + std::to_string(i) + " has a fourth number and a colour");
    if (has_w) {
      out += ' ';
      append_finite(out, mesh.vertex_w[i], "a vertex's fourth number");
    }
    if (has_colour) append_numbers(out, mesh.vertex_colours[i], "a vertex's colour");
    out += '\n';
  }
}

void append_texture_coordinates(std::string& out, const MeshFile& mesh) {
  if (mesh.texture_coordinates.empty()) return;
  out += "## texture coordinates\n";
  for (const Eigen::Vector3d& uvw : mesh.texture_coordinates) {
    out += "vt ";
    append_finite(out, uvw[0], "a texture coordinate");
    out += ' ';
    append_finite(out, uvw[1], "a texture coordinate");
    if (uvw[2] != 0.0 || std::signbit(uvw[2])) {
      out += ' ';
      append_finite(out, uvw[2], "a texture coordinate");
    }
    out += '\n';
  }
}

void append_normals(std::string& out, const MeshFile& mesh) {
  if (mesh.normals.empty()) return;
  out += "## normals\n";
  for (const Eigen::Vector3d& normal : mesh.normals) {
    out += "vn";
    append_numbers(out, normal, "a normal");
    out += '\n';
  }
}

void append_name(std::string& out, const char* keyword, std::string_view name) {
  const bool fits = name.find_first_of(std::string_view("\n\r\0", 3)) == std::string_view::npos && trim(name) == name &&
                    !name.ends_with('\\');
  if (!fits) refuse_obj("a name cannot be written: '" + printable(name) + "'");
  out += keyword;
  if (!name.empty()) out += ' ';
  out += name;
  out += '\n';
}

std::string_view name_of(const std::vector<std::string>& names, std::int32_t index) {
  if (index < 0) return {};
  if (static_cast<std::size_t>(index) >= names.size())
    refuse_obj("a part names entry " + std::to_string(index) + " of " + std::to_string(names.size()));
  return names[static_cast<std::size_t>(index)];
}

// The statements that lead from one part to the next.
void append_part(std::string& out, const MeshFile& mesh, const std::vector<std::string>& materials,
                 const MeshPart& before, const MeshPart& part) {
  if (part.object != before.object) append_name(out, "o", name_of(mesh.objects, part.object));
  if (part.group != before.group) append_name(out, "g", name_of(mesh.groups, part.group));
  if (part.material != before.material) append_name(out, "usemtl", name_of(materials, part.material));
  if (part.smoothing != before.smoothing) {
    append_name(out, "s", part.smoothing == 0 ? "off" : std::to_string(part.smoothing));
  }
}

void append_index(std::string& out, std::uint32_t index, std::size_t count, const char* what) {
  if (index >= count) refuse_obj(std::string(what) + " " + std::to_string(index) + " of " + std::to_string(count));
  append_number(out, static_cast<std::int64_t>(index) + 1);
}

bool has_corners(const std::vector<Triangle>& corners, std::size_t triangle) {
  if (corners.empty()) return false;
  const Triangle& c = corners[triangle];
  const auto none = std::count(c.begin(), c.end(), kNoIndex);
  if (none != 0 && none != 3)
    refuse_obj("triangle " + std::to_string(triangle) + " has an attribute at some corners only");
  return none == 0;
}

void append_face(std::string& out, const MeshFile& mesh, std::size_t i) {
  const bool texture = has_corners(mesh.texture_corners, i);
  const bool normal = has_corners(mesh.normal_corners, i);
  out += 'f';
  for (std::size_t k = 0; k < 3; ++k) {
    out += ' ';
    append_index(out, mesh.triangles[i][k], mesh.vertices.size(), "vertex");
    if (texture || normal) out += '/';
    if (texture) append_index(out, mesh.texture_corners[i][k], mesh.texture_coordinates.size(), "texture coordinate");
    if (normal) {
      out += '/';
      append_index(out, mesh.normal_corners[i][k], mesh.normals.size(), "normal");
    }
  }
  out += '\n';
}

void append_faces(std::string& out, const MeshFile& mesh) {
  out += "## faces\n";
  const std::vector<std::string> materials = unique_material_names(mesh.materials);
  MeshPart now;
  auto part = mesh.parts.begin();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (; part != mesh.parts.end() && part->first_triangle <= i; ++part) {
      append_part(out, mesh, materials, now, *part);
      now = *part;
    }
    append_face(out, mesh, i);
  }
}

void append_haptic(std::string& out, const MeshFile& mesh) {
  if (mesh.haptic.empty()) return;
  out += "## haptic texture coordinates\n";
  for (const HapticTriangle& triangle : mesh.haptic) {
    if (triangle.texture < -1) refuse_obj("texture index " + std::to_string(triangle.texture));
    out += "h ";
    append_number(out, static_cast<std::int64_t>(triangle.texture));
    for (const Eigen::Vector2d& xy : triangle.xy_mm) {
      out += ' ';
      append_decimal(out, xy.x());
      out += ' ';
      append_decimal(out, xy.y());
    }
    out += '\n';
  }
}

void require_length(std::size_t length, std::size_t expected, const char* what) {
  if (length != 0 && length != expected) {
    refuse_obj(std::to_string(length) + " " + what + " where " + std::to_string(expected) + " are needed");
  }
}

}  // namespace

std::string format_obj(const MeshFile& mesh) {
  require_length(mesh.vertex_w.size(), mesh.vertices.size(), "fourth numbers");
  require_length(mesh.vertex_colours.size(), mesh.vertices.size(), "vertex colours");
  require_length(mesh.texture_corners.size(), mesh.triangles.size(), "texture corners");
  require_length(mesh.normal_corners.size(), mesh.triangles.size(), "normal corners");
  require_length(mesh.haptic.size(), mesh.triangles.size(), "haptic triangles");
  std::string out;
  out.reserve(60 * mesh.vertices.size() + 30 * mesh.triangles.size() + 60 * mesh.haptic.size());
  for (const std::string& library : mesh.material_libraries) append_name(out, "mtllib", library);
  append_vertices(out, mesh);
  append_texture_coordinates(out, mesh);
  append_normals(out, mesh);
  append_faces(out, mesh);
  append_haptic(out, mesh);
  return out;
}

void write_obj(const std::filesystem::path& path, const MeshFile& mesh) { write_file(path, format_obj(mesh)); }

}  // namespace asperity
