#include "asperity/geometry/read_stl.h"

#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/text.h"
#include "plausible_coordinate.h"
#include "problem_counter.h"
#include "statement_lines.h"
#include "vertex_merger.h"

namespace asperity {

namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of text and the count
constexpr std::size_t kFacet = 50;   // normal, three corners, attribute

std::string to_lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

class StlParser {
 public:
  StlParser(std::string_view bytes, const std::string& name, const MeshLimits& limits, const Observer& observer)
      : bytes_(bytes),
        name_(name),
        limits_(limits),
        watch_(observer),
        merger_(mesh_.vertices),
        problems_(mesh_.problems) {}

  MeshFile parse() {
    const std::size_t facets =
        bytes_.size() >= kHeader ? load_number<std::uint32_t>(bytes_.data() + 80, std::endian::little) : 0;
    const bool fits = bytes_.size() >= kHeader && bytes_.size() == kHeader + kFacet * facets;
    const std::size_t first = bytes_.find_first_not_of(" \t\r\n");
    const bool solid = first != std::string_view::npos && to_lower(bytes_.substr(first, 5)) == "solid" &&
                       bytes_.find('\0') == std::string_view::npos;
    if (!fits && solid) {
      ascii();
    } else {
      binary(facets);
    }
    if (mesh_.triangles.empty()) throw Error(name_ + ": holds no triangles");
    return std::move(mesh_);
  }

 private:
  void require_room(const std::string& place, std::size_t triangles) const {
    if (triangles > limits_.triangles || 3 * triangles > 3 * limits_.vertices) {
      throw Error(place + ": more than " + std::to_string(std::min(limits_.triangles, limits_.vertices)) +
                  " triangles");
    }
  }

  void binary(std::size_t facets) {
    if (bytes_.size() < kHeader) throw Error(name_ + ": is not an STL: " + std::to_string(bytes_.size()) + " bytes");
    const std::size_t whole = (bytes_.size() - kHeader) / kFacet;
    if (facets > whole) {
      throw Error(name_ + ": is cut, or is not an STL: its header counts " + std::to_string(facets) + " triangles, " +
                  std::to_string(whole) + " are in it");
    }
    if (const std::size_t surplus = bytes_.size() - kHeader - kFacet * facets; surplus > 0) {
      mesh_.problems.push_back({"trailing_bytes", name_ + ": bytes after the last triangle", surplus});
    }
    require_room(name_, facets);
    mesh_.triangles.reserve(facets);
    for (std::size_t i = 0; i < facets; ++i) {
      const char* facet = bytes_.data() + kHeader + kFacet * i;
      const auto vector = [&](std::size_t k) {
        Eigen::Vector3d v;
        for (std::size_t j = 0; j < 3; ++j) {
          v[static_cast<Eigen::Index>(j)] = load_number<float>(facet + 12 * k + 4 * j, std::endian::little);
        }
        return v;
      };
      const auto place = [&] { return name_ + ": triangle " + std::to_string(i + 1); };
      for (std::size_t k = 0; k < 3; ++k) {
        corners_[k] = vector(k + 1);
        if (!corners_[k].allFinite()) throw Error(place() + ": a coordinate is not finite");
        if (!has_plausible_coordinates(corners_[k])) throw Error(place() + ": a coordinate is beyond 1e12");
      }
      add_triangle(vector(0), place);
      if (facet[48] != 0 || facet[49] != 0) {
        problems_.count("attribute", [&] { return place() + ": its attribute (a colour, perhaps) is not read"; });
      }
    }
  }

  template <class Place>
  void add_triangle(const Eigen::Vector3d& normal, const Place& place) {
    watch_.next();
    mesh_.triangles.push_back({merger_.add(corners_[0]), merger_.add(corners_[1]), merger_.add(corners_[2])});
    if ((corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]).dot(normal) < 0.0) {
      problems_.count("reversed_normal", [&] { return place() + ": the normal points against the corners' order"; });
    }
  }

  void ascii() {
    StatementLines lines(bytes_, name_, limits_.line_bytes);
    const auto require = [&](std::string_view keyword, std::string_view rest) {
      if (!lines.next()) throw Error(name_ + ": ends where '" + std::string(keyword) + "' is needed");
      if (to_lower(lines.keyword()) != keyword || to_lower(lines.rest()) != rest) {
        lines.fail("'" + printable(lines.keyword()) + "' where '" + std::string(keyword) + "' is needed");
      }
    };
    bool in_solid = false;
    while (lines.next()) {
      const std::string keyword = to_lower(lines.keyword());
      if (keyword == "solid" && !in_solid) {
        in_solid = true;
        begin_solid(lines.rest());
      } else if (keyword == "endsolid" && in_solid) {
        in_solid = false;
      } else if (keyword == "facet" && in_solid) {
        require_room(lines.place(), mesh_.triangles.size() + 1);
        std::string place = lines.place();
        std::string_view rest = lines.rest();
        if (to_lower(next_word(rest)) != "normal") lines.fail("'facet' without 'normal'");
        // Exporters write nan for the normal of a triangle without area; it is not used.
        const Eigen::Vector3d normal = vector(lines, rest, false);
        require("outer", "loop");
        for (Eigen::Vector3d& corner : corners_) {
          if (!lines.next() || to_lower(lines.keyword()) != "vertex") lines.fail("a facet needs three 'vertex' lines");
          rest = lines.rest();
          corner = vector(lines, rest, true);
        }
        require("endloop", "");
        require("endfacet", "");
        add_triangle(normal, [&] { return place; });
      } else {
        lines.fail("'" + printable(keyword) + "' does not belong here");
      }
    }
    if (in_solid) throw Error(name_ + ": ends before 'endsolid'");
  }

  static Eigen::Vector3d vector(const StatementLines& lines, std::string_view rest, bool finite) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = next_word(rest);
      const std::optional<double> value = parse_double(word);
      if (!value || (finite && !std::isfinite(*value))) lines.fail("'" + printable(word) + "' is not a coordinate");
      if (finite && !is_plausible_coordinate(*value)) lines.fail("'" + printable(word) + "' is beyond 1e12");
      v[i] = *value;
    }
    if (!rest.empty()) lines.fail("'" + printable(rest) + "' after three numbers");
    return v;
  }

  void begin_solid(std::string_view solid) {
    if (solid.empty() && mesh_.parts.empty()) return;
    MeshPart part;
    part.first_triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
    if (mesh_.parts.empty() && part.first_triangle > 0) mesh_.parts.emplace_back();
    if (!solid.empty()) {
      part.object = static_cast<std::int32_t>(mesh_.objects.size());
      mesh_.objects.emplace_back(solid);
    }
    mesh_.parts.push_back(part);
  }

  std::string_view bytes_;
  const std::string& name_;
  const MeshLimits& limits_;
  MeshFile mesh_;
  RowWatch watch_;
  VertexMerger merger_;
  ProblemCounter problems_;
  std::array<Eigen::Vector3d, 3> corners_;
};

}  // namespace

MeshFile parse_stl(std::string_view bytes, const std::string& name, const MeshLimits& limits,
                   const Observer& observer) {
  return StlParser(bytes, name, limits, observer).parse();
}

MeshFile read_stl(const std::filesystem::path& path, const MeshLimits& limits, const Observer& observer) {
  return parse_stl(read_file(path, limits.file_bytes), path.string(), limits, observer);
}

}  // namespace asperity
