#include "asperity/geometry/read_ply.h"

#include <array>
#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/text.h"
#include "asperity/geometry/triangulate_polygon.h"
#include "plausible_coordinate.h"
#include "ply_header.h"
#include "ply_numbers.h"
#include "problem_counter.h"

namespace asperity {

namespace {

// What colours of this type are divided by.
double full_scale(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return 127.0;
    case PlyType::kUint8:
      return 255.0;
    case PlyType::kInt16:
      return 32767.0;
    case PlyType::kUint16:
      return 65535.0;
    case PlyType::kInt32:
      return 2147483647.0;
    case PlyType::kUint32:
      return 4294967295.0;
    case PlyType::kFloat32:
    case PlyType::kFloat64:
      return 1.0;
  }
  return 1.0;
}

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& name, const MeshLimits& limits, const Observer& observer)
      : header_(parse_ply_header(bytes, name)),
        numbers_(bytes, header_, name, observer),
        name_(name),
        limits_(limits),
        problems_(mesh_.problems) {}

  MeshFile parse() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && mesh_.vertices.empty()) {
        vertices(element);
      } else if (element.name == "face" && mesh_.triangles.empty()) {
        faces(element);
      } else if (element.name == "tristrips" && mesh_.triangles.empty()) {
        strips(element);
      } else {
        skip_element(element);
      }
    }
    if (mesh_.vertices.empty()) throw Error(name_ + ": holds no vertices");
    if (mesh_.triangles.empty()) mesh_.problems.push_back({"no_faces", name_ + ": holds no faces"});
    if (!mesh_.normals.empty()) mesh_.normal_corners = mesh_.triangles;
    if (!mesh_.texture_coordinates.empty()) mesh_.texture_corners = mesh_.triangles;
    if (const std::size_t left = numbers_.bytes_left(); left > 0) {
      mesh_.problems.push_back({"trailing_bytes", name_ + ": bytes after the last element", left});
    }
    return std::move(mesh_);
  }

 private:
  // Where the value of each property of a vertex goes: 0 x, 1 y, 2 z, 3–5 normal, 6–8 colour, 9–10 texture.
  static constexpr int kValues = 11;

  static int place_of(const PlyProperty& property) {
    if (property.count_type) return -1;
    constexpr std::array<std::array<const char*, kValues>, 3> kNames{{
        {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "u", "v"},
        {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "s", "t"},
        {"x", "y", "z", "nx", "ny", "nz", "r", "g", "b", "texture_u", "texture_v"},
    }};
    for (const auto& names : kNames) {
      for (int i = 0; i < kValues; ++i) {
        if (property.name == names[static_cast<std::size_t>(i)]) return i;
      }
    }
    return -1;
  }

  void report(const PlyElement& element, const PlyProperty& property) {
    mesh_.problems.push_back(
        {"property",
         name_ + ": property '" + printable(property.name) + "' of '" + printable(element.name) + "' is not read",
         std::max<std::size_t>(element.count, 1)});
  }

  void skip(const PlyProperty& property) {
    const std::size_t count = property.count_type ? numbers_.next_count(*property.count_type) : 1;
    numbers_.skip(property.type, count);
  }

  void skip_element(const PlyElement& element) {
    if (element.count > 0) {
      mesh_.problems.push_back(
          {"element", name_ + ": element '" + printable(element.name) + "' is not read", element.count});
    }
    if (element.properties.empty()) return;
    for (std::size_t row = 0; row < element.count; ++row) {
      numbers_.set_place(element, row);
      for (const PlyProperty& property : element.properties) skip(property);
    }
  }

  void vertices(const PlyElement& element) {
    if (element.count > limits_.vertices) {
      throw Error(name_ + ": more than " + std::to_string(limits_.vertices) + " vertices");
    }
    std::vector<int> places;
    std::array<bool, kValues> has{};
    for (const PlyProperty& property : element.properties) {
      const int place = place_of(property);
      const bool taken = place >= 0 && has[static_cast<std::size_t>(place)];
      places.push_back(taken ? -1 : place);
      if (place >= 0) has[static_cast<std::size_t>(place)] = true;
    }
    if (!has[0] || !has[1] || !has[2]) throw Error(name_ + ": its vertices have no x, y and z");
    const bool normals = has[3] && has[4] && has[5];
    const bool colours = has[6] && has[7] && has[8];
    const bool texture = has[9] && has[10];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int place = places[i];
      const bool kept = place >= 0 && (place < 3 || (place < 6 && normals) || (place >= 6 && place < 9 && colours) ||
                                       (place >= 9 && texture));
      if (!kept) report(element, element.properties[i]);
      if (!kept) places[i] = -1;
    }
    mesh_.vertices.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    if (colours) mesh_.vertex_colours.reserve(element.count);
    if (texture) mesh_.texture_coordinates.reserve(element.count);
    std::array<double, kValues> values{};
    for (std::size_t row = 0; row < element.count; ++row) {
      numbers_.set_place(element, row);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (places[i] < 0) {
          skip(property);
          continue;
        }
        double value = numbers_.next(property.type);
        if (!is_plausible_coordinate(value)) {
          numbers_.fail("'" + property.name + "' is " + number_text(value) +
                        (std::isfinite(value) ? ", beyond 1e12" : ""));
        }
        if (places[i] >= 6 && places[i] < 9) value /= full_scale(property.type);
        values[static_cast<std::size_t>(places[i])] = value;
      }
      mesh_.vertices.emplace_back(values[0], values[1], values[2]);
      if (normals) mesh_.normals.emplace_back(values[3], values[4], values[5]);
      if (colours) mesh_.vertex_colours.emplace_back(values[6], values[7], values[8]);
      if (texture) mesh_.texture_coordinates.emplace_back(values[9], values[10], 0.0);
    }
  }

  void faces(const PlyElement& element) {
    if (mesh_.vertices.empty() && element.count > 0) throw Error(name_ + ": its faces come before its vertices");
    std::size_t list = element.properties.size();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const bool indices =
          property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
      const bool whole = property.type != PlyType::kFloat32 && property.type != PlyType::kFloat64;
      if (indices && whole && list == element.properties.size()) {
        list = i;
      } else {
        report(element, property);
      }
    }
    if (list == element.properties.size()) throw Error(name_ + ": its faces have no whole 'vertex_indices'");
    mesh_.triangles.reserve(std::min(element.count, limits_.triangles));
    for (std::size_t row = 0; row < element.count; ++row) {
      numbers_.set_place(element, row);
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == list) {
          face(element.properties[i]);
        } else {
          skip(element.properties[i]);
        }
      }
      if (corners_.size() >= 3) {
        add_polygon(row);
      } else {
        problems_.count("short_face", [&] { return face_name(row) + " has fewer than three corners and is left out"; });
      }
    }
  }

  void face(const PlyProperty& property) {
    const std::size_t count = numbers_.next_count(*property.count_type);
    if (count > limits_.polygon_corners)
      numbers_.fail("more than " + std::to_string(limits_.polygon_corners) + " corners");
    corners_.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const double index = numbers_.next(property.type);
      if (!(index >= 0.0 && index < static_cast<double>(mesh_.vertices.size()))) {
        numbers_.fail("vertex " + number_text(index) + " of " + std::to_string(mesh_.vertices.size()));
      }
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
  }

  // Strips of triangles as Stanford's files have them: each corner makes a triangle with the two before it, every
  // second one turned; −1 begins a new strip. A triangle with the same corner twice is the strip's own joint and left
  // out.
  void strips(const PlyElement& element) {
    if (mesh_.vertices.empty() && element.count > 0) throw Error(name_ + ": its strips come before its vertices");
    for (std::size_t row = 0; row < element.count; ++row) {
      numbers_.set_place(element, row);
      for (const PlyProperty& property : element.properties) {
        const bool whole = property.type != PlyType::kFloat32 && property.type != PlyType::kFloat64;
        if (property.count_type && whole && (property.name == "vertex_indices" || property.name == "vertex_index")) {
          strip(property);
        } else {
          if (row == 0) report(element, property);
          skip(property);
        }
      }
    }
  }

  void strip(const PlyProperty& property) {
    const std::size_t count = numbers_.next_count(*property.count_type);
    Triangle last{};
    std::size_t corners = 0;  // of this strip
    for (std::size_t k = 0; k < count; ++k) {
      const double index = numbers_.next(property.type);
      if (index == -1.0) {
        corners = 0;
        continue;
      }
      if (!(index >= 0.0 && index < static_cast<double>(mesh_.vertices.size())))
        numbers_.fail("vertex " + number_text(index) + " of " + std::to_string(mesh_.vertices.size()));
      last = {last[1], last[2], static_cast<std::uint32_t>(index)};
      if (++corners < 3 || last[0] == last[1] || last[1] == last[2] || last[2] == last[0]) continue;
      if (mesh_.triangles.size() == limits_.triangles)
        numbers_.fail("more than " + std::to_string(limits_.triangles) + " triangles");
      mesh_.triangles.push_back(corners % 2 == 1 ? last : Triangle{last[1], last[0], last[2]});
    }
  }

  std::string face_name(std::size_t row) const { return name_ + ": face " + std::to_string(row) + " (from 0)"; }

  void add_polygon(std::size_t row) {
    if (limits_.triangles - mesh_.triangles.size() < corners_.size() - 2) {
      numbers_.fail("more than " + std::to_string(limits_.triangles) + " triangles");
    }
    pieces_.clear();
    if (corners_.size() == 3) {
      pieces_.push_back({0, 1, 2});
    } else {
      points_.clear();
      for (const std::uint32_t corner : corners_) points_.push_back(mesh_.vertices[corner]);
      const PolygonShape shape = triangulate_polygon(points_, pieces_);
      if (shape == PolygonShape::kCrossing) {
        problems_.count("crossing_polygon", [&] { return face_name(row) + ": its outline crosses itself"; });
      } else if (shape == PolygonShape::kDegenerate) {
        problems_.count("polygon_without_area", [&] { return face_name(row) + " has no area"; });
      }
    }
    for (const Triangle& piece : pieces_) {
      const Triangle triangle{corners_[piece[0]], corners_[piece[1]], corners_[piece[2]]};
      mesh_.triangles.push_back(triangle);
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
        problems_.count("repeated_vertex", [&] { return face_name(row) + " has the same vertex twice"; });
      }
    }
  }

  PlyHeader header_;
  PlyNumbers numbers_;
  const std::string& name_;
  const MeshLimits& limits_;
  MeshFile mesh_;
  ProblemCounter problems_;
  std::vector<std::uint32_t> corners_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> pieces_;
};

}  // namespace

MeshFile parse_ply(std::string_view bytes, const std::string& name, const MeshLimits& limits,
                   const Observer& observer) {
  return PlyParser(bytes, name, limits, observer).parse();
}

MeshFile read_ply(const std::filesystem::path& path, const MeshLimits& limits, const Observer& observer) {
  return parse_ply(read_file(path, limits.file_bytes), path.string(), limits, observer);
}

}  // namespace asperity
