#include "asperity/geometry/read_obj.h"

#include <unordered_map>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_mtl.h"
#include "problem_counter.h"
#include "statement_lines.h"

namespace asperity {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxLibraryBytes = 16u << 20;
constexpr std::size_t kMaxLibraries = 64;

// The file names of an `mtllib` statement: several, separated by blanks; a blank after a backslash is
// part of a name.
std::vector<std::string> library_names(std::string_view statement) {
  std::vector<std::string> names;
  bool in_name = false;
  for (std::size_t i = 0; i < statement.size(); ++i) {
    const bool escaped = statement[i] == '\\' && i + 1 < statement.size() && is_blank(statement[i + 1]);
    if (!escaped && is_blank(statement[i])) {
      in_name = false;
      continue;
    }
    if (!in_name) names.emplace_back();
    in_name = true;
    if (escaped) ++i;
    names.back() += statement[i];
  }
  return names;
}

class LibraryReader {
 public:
  LibraryReader(const fs::path& path, MeshFile& mesh) : path_(path), mesh_(mesh), problems_(mesh.problems) {
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) places_.emplace(mesh.materials[i].name, i);
    defined_.resize(mesh.materials.size(), false);
  }

  void read() {
    for (const std::string& statement : mesh_.material_libraries) {
      if (exists(statement)) {
        library(statement);
      } else {
        for (const std::string& name : library_names(statement)) library(name);
      }
    }
    for (std::size_t i = 0; i < defined_.size(); ++i) {
      if (defined_[i]) continue;
      problems_.count("undefined_material", [&] {
        return path_.string() + ": no library defines the material '" + printable(mesh_.materials[i].name) + "'";
      });
    }
  }

 private:
  bool exists(const std::string& name) const {
    const std::optional<fs::path> file = inner_file(path_.parent_path(), name);
    std::error_code error;
    return file && fs::is_regular_file(*file, error);
  }

  void library(const std::string& name) {
    const std::string shown = path_.string() + ": the material library '" + printable(name) + "' ";
    if (!inner_file(path_.parent_path(), name)) {
      return problems_.count("outside_path", [&] { return shown + "is outside the mesh's folder and is not read"; });
    }
    if (!exists(name)) return problems_.count("missing_library", [&] { return shown + "is missing"; });
    if (libraries_++ == kMaxLibraries) {
      return problems_.count("libraries", [&] { return shown + "is one of more than 64 and not read"; });
    }
    try {
      const fs::path file = *inner_file(path_.parent_path(), name);
      MaterialLibrary library = parse_mtl(read_file(file, kMaxLibraryBytes), (path_.parent_path() / name).string());
      for (MeshMaterial& material : library.materials) add(std::move(material));
      mesh_.problems.insert(mesh_.problems.end(), library.problems.begin(), library.problems.end());
    } catch (const Error& error) {
      problems_.count("unreadable_library", [&] { return std::string(error.what()); });
    }
  }

  void add(MeshMaterial material) {
    const auto [entry, is_new] = places_.try_emplace(material.name, mesh_.materials.size());
    if (is_new) {
      mesh_.materials.push_back(std::move(material));
      defined_.push_back(true);
    } else if (!defined_[entry->second]) {
      mesh_.materials[entry->second] = std::move(material);
      defined_[entry->second] = true;
    } else {
      problems_.count("material_twice", [&] {
        return path_.string() + ": two libraries define '" + printable(material.name) + "'; the first is kept";
      });
    }
  }

  const fs::path& path_;
  MeshFile& mesh_;
  ProblemCounter problems_;
  std::unordered_map<std::string, std::size_t> places_;
  std::vector<bool> defined_;
  std::size_t libraries_ = 0;
};

}  // namespace

MeshFile read_obj(const fs::path& path, const MeshLimits& limits, const Observer& observer) {
  MeshFile mesh = parse_obj(read_file(path, limits.file_bytes), path.string(), limits, observer);
  LibraryReader(path, mesh).read();
  return mesh;
}

}  // namespace asperity
