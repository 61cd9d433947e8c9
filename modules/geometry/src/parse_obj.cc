#include <array>
#include <charconv>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/triangulate_polygon.h"
#include "obj_parts.h"
#include "obj_words.h"
#include "problem_counter.h"
#include "statement_lines.h"

namespace asperity {

namespace {

constexpr Triangle kNoTriangle{kNoIndex, kNoIndex, kNoIndex};

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name, const MeshLimits& limits, const Observer& observer)
      : lines_(text, name, limits.line_bytes, observer),
        name_(name),
        limits_(limits),
        problems_(mesh_.problems),
        parts_(lines_, mesh_) {}

  MeshFile parse() {
    while (lines_.next()) statement();
    finish();
    return std::move(mesh_);
  }

 private:
  void statement() {
    const std::string_view keyword = lines_.keyword();
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();
    if (keyword == "vt") return texture_coordinate();
    if (keyword == "vn") return normal();
    if (keyword == "h") return haptic();
    if (keyword == "g") return parts_.group();
    if (keyword == "usemtl") return parts_.material();
    if (keyword == "o") return parts_.object();
    if (keyword == "s") return parts_.smoothing();
    if (keyword == "mtllib") return library();
    left_out(keyword);
  }

  // The numbers of the line, at most `most`.
  std::span<const double> numbers(std::size_t least, std::size_t most) {
    std::string_view rest = lines_.rest();
    std::size_t count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      if (count == most) {
        lines_.fail("'" + printable(word) + "' after " + std::to_string(most) + " numbers of '" +
                    std::string(lines_.keyword()) + "'");
      }
      numbers_[count++] = finite_number(lines_, word);
    }
    if (count < least) {
      lines_.fail("'" + std::string(lines_.keyword()) + "' has " + std::to_string(count) + " numbers, it needs " +
                  std::to_string(least));
    }
    return {numbers_.data(), count};
  }

  // `values` brought to one a vertex, with `none` where nothing was said.
  template <class Value>
  void attach(std::vector<Value>& values, const Value& none, const Value& value) {
    if (values.empty()) values.reserve(mesh_.vertices.capacity());
    values.resize(mesh_.vertices.size() - 1, none);
    values.push_back(value);
  }

  void vertex() {
    const std::span<const double> n = numbers(3, 6);
    if (n.size() == 5) lines_.fail("'v' has 5 numbers; x y z, x y z w or x y z r g b are known");
    if (mesh_.vertices.size() == limits_.vertices)
      lines_.fail("more than " + std::to_string(limits_.vertices) + " vertices");
    mesh_.vertices.emplace_back(n[0], n[1], n[2]);
    if (n.size() == 4) attach(mesh_.vertex_w, kNan, n[3]);
    if (n.size() == 6) {
      attach<Eigen::Vector3d>(mesh_.vertex_colours, Eigen::Vector3d::Constant(kNan), Eigen::Vector3d(n[3], n[4], n[5]));
    }
  }

  void texture_coordinate() {
    const std::span<const double> n = numbers(1, 3);
    if (mesh_.texture_coordinates.size() == limits_.vertices) lines_.fail("too many texture coordinates");
    mesh_.texture_coordinates.emplace_back(n[0], n.size() > 1 ? n[1] : 0.0, n.size() > 2 ? n[2] : 0.0);
  }

  void normal() {
    const std::span<const double> n = numbers(3, 3);
    if (mesh_.normals.size() == limits_.vertices) lines_.fail("too many normals");
    mesh_.normals.emplace_back(n[0], n[1], n[2]);
  }

  void face() {
    if (!mesh_.haptic.empty()) lines_.fail("a face after the first 'h' line; they follow the faces");
    corners_.clear();
    std::string_view rest = lines_.rest();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      if (corners_.size() == limits_.polygon_corners) {
        lines_.fail("a face of more than " + std::to_string(limits_.polygon_corners) + " corners");
      }
      corners_.push_back(obj_corner(lines_, word, mesh_));
      if ((corners_.back().texture == kNoIndex) != (corners_.front().texture == kNoIndex)) {
        lines_.fail("'" + printable(word) + "': some corners of the face have a texture coordinate and some have none");
      }
      if ((corners_.back().normal == kNoIndex) != (corners_.front().normal == kNoIndex)) {
        lines_.fail("'" + printable(word) + "': some corners of the face have a normal and some have none");
      }
    }
    if (corners_.size() < 3) lines_.fail("a face of " + std::to_string(corners_.size()) + " corners, it needs 3");
    if (limits_.triangles - mesh_.triangles.size() < corners_.size() - 2) {
      lines_.fail("more than " + std::to_string(limits_.triangles) + " triangles");
    }
    parts_.begin_triangle();
    if (corners_.size() == 3) {
      add_triangle({0, 1, 2});
    } else {
      add_polygon();
    }
  }

  void add_polygon() {
    if (polygon_line_ == 0) polygon_line_ = lines_.line();
    points_.clear();
    for (const ObjCorner& c : corners_) points_.push_back(mesh_.vertices[c.vertex]);
    pieces_.clear();
    const PolygonShape shape = triangulate_polygon(points_, pieces_);
    for (const Triangle& piece : pieces_) add_triangle(piece);
    if (shape == PolygonShape::kCrossing) {
      problems_.count("crossing_polygon",
                      [&] { return lines_.place() + ": the outline of the polygon crosses itself"; });
    } else if (shape == PolygonShape::kDegenerate) {
      problems_.count("polygon_without_area", [&] { return lines_.place() + ": the polygon has no area"; });
    }
  }

  void add_triangle(const Triangle& piece) {
    const ObjCorner& a = corners_[piece[0]];
    const ObjCorner& b = corners_[piece[1]];
    const ObjCorner& c = corners_[piece[2]];
    const std::size_t before = mesh_.triangles.size();
    mesh_.triangles.push_back({a.vertex, b.vertex, c.vertex});
    if (a.vertex == b.vertex || b.vertex == c.vertex || c.vertex == a.vertex) {
      problems_.count("repeated_vertex", [&] { return lines_.place() + ": a triangle has the same vertex twice"; });
    }
    if (a.texture != kNoIndex) {
      mesh_.texture_corners.resize(before, kNoTriangle);
      mesh_.texture_corners.push_back({a.texture, b.texture, c.texture});
    }
    if (a.normal != kNoIndex) {
      mesh_.normal_corners.resize(before, kNoTriangle);
      mesh_.normal_corners.push_back({a.normal, b.normal, c.normal});
    }
  }

  void library() {
    if (lines_.rest().empty()) lines_.fail("'mtllib' without a file name");
    library_names_.find(lines_.rest(), [&](const std::string& name) { mesh_.material_libraries.push_back(name); });
  }

  void haptic() {
    if (polygon_line_ != 0) {
      lines_.fail("'h' lines need a file of triangles; the face of line " + std::to_string(polygon_line_) +
                  " has more corners");
    }
    if (mesh_.haptic.size() == mesh_.triangles.size()) {
      lines_.fail("more 'h' lines than faces (" + std::to_string(mesh_.triangles.size()) + ")");
    }
    if (mesh_.haptic.empty()) mesh_.haptic.reserve(mesh_.triangles.size());
    std::string_view rest = lines_.rest();
    const std::string_view word = next_word(rest);
    HapticTriangle haptic;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), haptic.texture);
    if (error != std::errc{} || end != word.data() + word.size() || haptic.texture < -1) {
      lines_.fail("texture index '" + printable(word) + "' is not a whole number of -1 or more");
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string_view value = next_word(rest);
      if (value.empty()) lines_.fail("'h' has " + std::to_string(i) + " coordinates, it needs 6");
      haptic.xy_mm[i / 2][static_cast<Eigen::Index>(i % 2)] = finite_number(lines_, value);
    }
    if (const std::string_view word_more = next_word(rest); !word_more.empty()) {
      lines_.fail("'" + printable(word_more) + "' after the 6 coordinates of 'h'");
    }
    mesh_.haptic.push_back(haptic);
  }

  void left_out(std::string_view keyword) {
    if (keyword == "p") {
      problems_.count("points", [&] { return lines_.place() + ": point elements are left out"; });
    } else if (keyword == "l") {
      problems_.count("lines", [&] { return lines_.place() + ": line elements are left out"; });
    } else if (const std::string shown = printable(keyword, 20); mesh_.problems.size() < kMaxKinds) {
      problems_.count("statement " + shown, [&] { return lines_.place() + ": '" + shown + "' is not read"; });
    } else {
      problems_.count("statements",
                      [&] { return lines_.place() + ": '" + shown + "' and other statements are not read"; });
    }
  }

  void finish() {
    if (mesh_.vertices.empty()) throw Error(name_ + ": holds no vertices ('v' lines)");
    if (!mesh_.haptic.empty() && mesh_.haptic.size() != mesh_.triangles.size()) {
      lines_.fail(std::to_string(mesh_.haptic.size()) + " 'h' lines for " + std::to_string(mesh_.triangles.size()) +
                  " faces; each face needs one");
    }
    if (mesh_.triangles.empty()) problems_.count("no_faces", [&] { return name_ + ": holds no faces"; });
    if (!mesh_.vertex_w.empty()) mesh_.vertex_w.resize(mesh_.vertices.size(), kNan);
    if (!mesh_.vertex_colours.empty()) {
      mesh_.vertex_colours.resize(mesh_.vertices.size(), Eigen::Vector3d::Constant(kNan));
    }
    if (!mesh_.texture_corners.empty()) mesh_.texture_corners.resize(mesh_.triangles.size(), kNoTriangle);
    if (!mesh_.normal_corners.empty()) mesh_.normal_corners.resize(mesh_.triangles.size(), kNoTriangle);
  }

  static constexpr std::size_t kMaxKinds = 32;

  StatementLines lines_;
  const std::string& name_;
  const MeshLimits& limits_;
  MeshFile mesh_;
  ProblemCounter problems_;
  ObjParts parts_;
  NameTable library_names_;
  std::size_t polygon_line_ = 0;
  std::array<double, 6> numbers_{};
  std::vector<ObjCorner> corners_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> pieces_;
};

}  // namespace

MeshFile parse_obj(std::string_view text, const std::string& name, const MeshLimits& limits, const Observer& observer) {
  if (text.size() > limits.file_bytes)
    throw Error(name + ": is larger than " + std::to_string(limits.file_bytes) + " bytes");
  return ObjParser(text, name, limits, observer).parse();
}

}  // namespace asperity
