#include "asperity/geometry/read_off.h"

#include <algorithm>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/triangulate_polygon.h"
#include "obj_words.h"
#include "plausible_coordinate.h"
#include "problem_counter.h"
#include "statement_lines.h"

namespace asperity {

namespace {

class OffParser {
 public:
  OffParser(std::string_view text, const std::string& name, const MeshLimits& limits, const Observer& observer)
      : lines_(text, name, limits.line_bytes, observer),
        text_bytes_(text.size()),
        name_(name),
        limits_(limits),
        problems_(mesh_.problems) {}

  MeshFile parse() {
    header();
    for (std::size_t i = 0; i < vertices_; ++i) vertex(i);
    if (coloured_) scale_colours();
    for (std::size_t i = 0; i < faces_; ++i) face(i);
    if (lines_.next()) lines_.fail("'" + printable(lines_.keyword()) + "' after the last face");
    if (mesh_.triangles.empty()) throw Error(name_ + ": has no faces");
    return std::move(mesh_);
  }

 private:
  // The words of the next line.
  void next_line(const char* what, std::size_t index, std::size_t count) {
    if (!lines_.next())
      throw Error(name_ + ": ends before " + what + " " + std::to_string(index + 1) + " of " + std::to_string(count));
    words_.clear();
    words_.push_back(lines_.keyword());
    std::string_view rest = lines_.rest();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) words_.push_back(word);
  }

  std::size_t whole(std::string_view word, const char* what) const {
    const auto value = parse_int64(word);
    if (!value || *value < 0) lines_.fail("'" + printable(word) + "' is not " + what);
    return static_cast<std::size_t>(*value);
  }

  void header() {
    next_line("the header", 0, 1);
    const std::string_view kind = words_.front();
    if (kind.ends_with("OFF")) {
      coloured_ = kind == "COFF";
      if (kind != "OFF" && !coloured_) lines_.fail("'" + printable(kind) + "' is not read; OFF and COFF are");
      words_.erase(words_.begin());
      if (!words_.empty() && words_.front() == "BINARY") lines_.fail("binary OFF is not read");
      if (words_.empty()) next_line("the numbers of vertices and faces", 0, 1);
    }
    if (words_.size() < 2 || words_.size() > 3) lines_.fail("the numbers of vertices, faces and edges are missing");
    vertices_ = whole(words_[0], "a number of vertices");
    faces_ = whole(words_[1], "a number of faces");
    if (vertices_ > limits_.vertices) lines_.fail("more than " + std::to_string(limits_.vertices) + " vertices");
    if (faces_ > limits_.triangles) lines_.fail("more than " + std::to_string(limits_.triangles) + " faces");
    // A vertex takes at least six bytes, a face four: what cannot be there takes no memory.
    if (vertices_ > text_bytes_ / 5 || faces_ > text_bytes_ / 3)
      lines_.fail(std::to_string(vertices_) + " vertices and " + std::to_string(faces_) + " faces do not fit in " +
                  std::to_string(text_bytes_) + " bytes");
    mesh_.vertices.reserve(vertices_);
    mesh_.triangles.reserve(faces_);
  }

  void vertex(std::size_t index) {
    next_line("vertex", index, vertices_);
    const std::size_t least = coloured_ ? 6 : 3;
    if (words_.size() < least || words_.size() > (coloured_ ? 7 : 3)) {
      lines_.fail("a vertex of " + std::to_string(words_.size()) + " numbers, it needs " + std::to_string(least));
    }
    Eigen::Vector3d p;
    for (std::size_t k = 0; k < 3; ++k) p[static_cast<Eigen::Index>(k)] = finite_number(lines_, words_[k]);
    if (!has_plausible_coordinates(p)) lines_.fail("a coordinate beyond 1e12");
    mesh_.vertices.push_back(p);
    if (!coloured_) return;
    Eigen::Vector3d c;
    for (std::size_t k = 0; k < 3; ++k) c[static_cast<Eigen::Index>(k)] = finite_number(lines_, words_[3 + k]);
    mesh_.vertex_colours.push_back(c);
    if (words_.size() == 7)
      problems_.count("alpha", [&] { return lines_.place() + ": the opacity of vertices is not kept"; });
  }

  void scale_colours() {
    constexpr double kByte = 255.0;
    const bool bytes = std::any_of(mesh_.vertex_colours.begin(), mesh_.vertex_colours.end(),
                                   [](const Eigen::Vector3d& c) { return c.maxCoeff() > 1.0; });
    if (!bytes) return;
    for (Eigen::Vector3d& c : mesh_.vertex_colours) c /= kByte;
  }

  void face(std::size_t index) {
    next_line("face", index, faces_);
    const std::size_t corners = whole(words_[0], "a number of corners");
    if (corners < 3) lines_.fail("a face of " + std::to_string(corners) + " corners, it needs 3");
    if (corners > limits_.polygon_corners)
      lines_.fail("a face of more than " + std::to_string(limits_.polygon_corners) + " corners");
    if (words_.size() < corners + 1)
      lines_.fail("a face of " + std::to_string(corners) + " corners has " + std::to_string(words_.size() - 1));
    if (limits_.triangles - mesh_.triangles.size() < corners - 2)
      lines_.fail("more than " + std::to_string(limits_.triangles) + " triangles");
    indices_.clear();
    for (std::size_t k = 1; k <= corners; ++k) {
      const std::size_t vertex = whole(words_[k], "an index of a vertex");
      if (vertex >= mesh_.vertices.size())
        lines_.fail("vertex " + std::to_string(vertex) + " of " + std::to_string(mesh_.vertices.size()));
      indices_.push_back(static_cast<std::uint32_t>(vertex));
    }
    if (words_.size() > corners + 1)
      problems_.count("face_colour", [&] { return lines_.place() + ": colours of faces are not kept"; });
    if (corners == 3) {
      add({0, 1, 2});
      return;
    }
    points_.clear();
    for (const std::uint32_t v : indices_) points_.push_back(mesh_.vertices[v]);
    pieces_.clear();
    const PolygonShape shape = triangulate_polygon(points_, pieces_);
    for (const Triangle& piece : pieces_) add(piece);
    if (shape == PolygonShape::kCrossing) {
      problems_.count("crossing_polygon",
                      [&] { return lines_.place() + ": the outline of the polygon crosses itself"; });
    } else if (shape == PolygonShape::kDegenerate) {
      problems_.count("polygon_without_area", [&] { return lines_.place() + ": the polygon has no area"; });
    }
  }

  void add(const Triangle& piece) {
    const Triangle t{indices_[piece[0]], indices_[piece[1]], indices_[piece[2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      problems_.count("repeated_vertex", [&] { return lines_.place() + ": a triangle has the same vertex twice"; });
    mesh_.triangles.push_back(t);
  }

  StatementLines lines_;
  std::size_t text_bytes_;
  const std::string& name_;
  const MeshLimits& limits_;
  MeshFile mesh_;
  ProblemCounter problems_;
  bool coloured_ = false;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::vector<std::string_view> words_;
  std::vector<std::uint32_t> indices_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> pieces_;
};

}  // namespace

MeshFile parse_off(std::string_view text, const std::string& name, const MeshLimits& limits, const Observer& observer) {
  return OffParser(text, name, limits, observer).parse();
}

MeshFile read_off(const std::filesystem::path& path, const MeshLimits& limits, const Observer& observer) {
  return parse_off(read_file(path, limits.file_bytes), path.string(), limits, observer);
}

}  // namespace asperity
