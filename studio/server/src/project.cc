#include "asperity/studio/project.h"

#include <algorithm>
#include <array>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 3;
constexpr std::size_t kMostEntries = 10'000;
constexpr std::size_t kMostVisited = 100'000;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::optional<EntryKind> kind_of_file(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with("scene.json")) return EntryKind::kScene;
  if (name.ends_with("texture.json")) return EntryKind::kTexture;
  if (name.ends_with(".study.json")) return EntryKind::kStudy;
  if (name.ends_with(".study.csv")) return EntryKind::kStudyLog;
  constexpr std::array<std::string_view, 6> meshes{".obj", ".ply", ".stl", ".off", ".gltf", ".glb"};
  constexpr std::array<std::string_view, 2> images{".png", ".pgm"};
  constexpr std::array<std::string_view, 8> surfaces{".gsf", ".sdf", ".sur", ".pro", ".x3p", ".smd", ".tif", ".tiff"};
  constexpr std::array<std::string_view, 5> tables{".csv", ".tsv", ".txt", ".dat", ".log"};
  const std::string extension = path.extension().string();
  if (std::find(meshes.begin(), meshes.end(), extension) != meshes.end()) return EntryKind::kMesh;
  if (std::find(images.begin(), images.end(), extension) != images.end()) return EntryKind::kImage;
  if (std::find(surfaces.begin(), surfaces.end(), extension) != surfaces.end()) return EntryKind::kSurface;
  if (std::find(tables.begin(), tables.end(), extension) != tables.end()) return EntryKind::kTable;
  return std::nullopt;
}

void list_folder(const fs::path& folder, const std::string& prefix, int depth, std::size_t& visited,
                 std::vector<Entry>& out) {
  std::error_code error;
  const bool is_result = is_file(folder / "result.json");  // its tables are ours, and nothing to import
  for (fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end; at != end;
       at.increment(error)) {
    if (error || out.size() >= kMostEntries || ++visited > kMostVisited) return;
    const std::string name = at->path().filename().string();
    if (name.starts_with('.') || !is_utf8(name) || at->is_symlink(error)) continue;
    if (at->is_directory(error)) {
      if (is_file(at->path() / "recording.json")) {
        out.push_back({EntryKind::kRecording, prefix + name});
        continue;
      }
      if (is_file(at->path() / "result.json") && is_file(at->path() / "profile.csv")) {
        out.push_back({EntryKind::kResult, prefix + name});
      }
      if (depth < kDeepest) list_folder(at->path(), prefix + name + "/", depth + 1, visited, out);
    } else if (const std::optional<EntryKind> kind = kind_of_file(at->path());
               kind && !(is_result && *kind == EntryKind::kTable)) {
      out.push_back({*kind, prefix + name});
    }
  }
}

// A folder that is opened is read by the names of what is in it: scene.json, texture.json, profile.csv.
void check_links(const fs::path& project, const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path ending = at->path().extension();
    if ((ending != ".json" && ending != ".csv") || !at->is_symlink(error)) continue;
    const std::string name = at->path().lexically_relative(project).string();
    if (inner_file(project, name)) continue;
    throw Advice(printable(name, 200) + ": is a link that leads out of the project's folder",
                 "Copy the file into the folder instead.");
  }
}

}  // namespace

bool is_taken(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::status_known(status))
    throw Error(printable(path.string(), 200) + ": cannot be looked up: " + error.message());
  return fs::exists(status);
}

Project::Project(fs::path folder) {
  std::error_code error;
  folder_ = fs::canonical(folder, error);
  if (error || !fs::is_directory(folder_, error)) throw Error(printable(folder.string(), 200) + ": is not a folder");
}

std::vector<Entry> Project::entries() const {
  std::vector<Entry> out;
  std::size_t visited = 0;
  list_folder(folder_, "", 1, visited, out);
  std::sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return out;
}

fs::path Project::existing(const std::string& name) const {
  std::error_code error;
  const fs::path path = writable(name);
  if (!fs::exists(path, error))
    throw Advice(printable(name, 200) + ": is not in the project's folder",
                 "Choose a file of the folder, or copy this one into it.");
  if (fs::is_directory(path, error)) check_links(folder_, path);
  return path;
}

fs::path Project::writable(const std::string& name) const {
  const std::optional<fs::path> path = is_utf8(name) ? inner_file(folder_, name) : std::nullopt;
  if (!path || *path == folder_) {
    throw Advice(printable(name, 200) + ": is not a name inside the project's folder",
                 "Give a name such as \"first\", without .. and without / at the beginning.");
  }
  for (const fs::path& part : path->lexically_relative(folder_)) {
    if (part.string().starts_with('.'))
      throw Advice(printable(name, 200) + ": is a hidden file", "Give a name that does not begin with a dot.");
  }
  std::error_code error;
  if (!fs::is_directory(path->parent_path(), error)) {
    throw Advice(printable(name, 200) + ": its folder does not exist",
                 "Give a name without /, or create that folder first.");
  }
  return *path;
}

std::string Project::free_name(const std::string& stem, const std::string& extension) const {
  std::string name = stem + extension;
  for (int i = 2; is_taken(folder_ / name); ++i) name = stem + "_" + std::to_string(i) + extension;
  return name;
}

}  // namespace asperity::studio
