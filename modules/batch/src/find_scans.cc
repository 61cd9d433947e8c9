#include "asperity/batch/find_scans.h"

#include <fnmatch.h>

#include <algorithm>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr int kDeepest = 32;  // folders below each other that ** looks into

bool is_pattern(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }
bool is_recording(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "recording.json", ignored);
}

// The folders in `folder`, by name; what may not be read has none. Links to folders are followed once, as names.
std::vector<std::string> folders_in(const fs::path& folder) {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator i(folder.empty() ? fs::path(".") : folder, error), end; !error && i != end;
       i.increment(error)) {
    std::error_code ignored;
    const std::string name = i->path().filename().string();
    if (!name.starts_with('.') && i->is_directory(ignored)) out.push_back(name);
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Adds the recordings below `found` (relative to `folder`) that match the parts of a pattern from `part` on.
void match(const fs::path& folder, const fs::path& found, const std::vector<std::string>& parts, std::size_t part,
           int depth, std::set<fs::path>& out) {
  if (part == parts.size()) {
    if (is_recording(folder / found)) out.insert(found);
    return;
  }
  const std::string& wanted = parts[part];
  if (wanted == "**") {
    match(folder, found, parts, part + 1, depth, out);
    if (depth >= kDeepest) return;
    for (const std::string& name : folders_in(folder / found)) {
      std::error_code ignored;
      if (fs::is_symlink(folder / found / name, ignored)) continue;  // else a link upwards has no end
      match(folder, found / name, parts, part, depth + 1, out);
    }
  } else if (is_pattern(wanted)) {
    for (const std::string& name : folders_in(folder / found)) {
      if (::fnmatch(wanted.c_str(), name.c_str(), FNM_PERIOD) == 0)
        match(folder, found / name, parts, part + 1, depth, out);
    }
  } else {
    match(folder, found / wanted, parts, part + 1, depth, out);
  }
}

std::vector<std::string> parts_of(const fs::path& path) {
  std::vector<std::string> out;
  for (const fs::path& part : path.lexically_normal()) {
    if (!part.empty() && part != ".") out.push_back(part.string());
  }
  return out;
}

// The names below the deepest folder that holds all; a recording alone has its folder's own name.
void name_scans(const fs::path& folder, std::vector<BatchScan>& scans) {
  std::vector<std::vector<std::string>> all;
  all.reserve(scans.size());
  for (const BatchScan& scan : scans) all.push_back(parts_of(fs::absolute(folder / scan.path)));
  std::size_t common = all.empty() ? 0 : all.front().size() - 1;
  for (const auto& parts : all) {
    std::size_t same = 0;
    while (same < common && same + 1 < parts.size() && parts[same] == all.front()[same]) ++same;
    common = same;
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (std::size_t j = common; j < all[i].size(); ++j) scans[i].name += (j == common ? "" : "/") + all[i][j];
  }
}

}  // namespace

std::vector<BatchScan> find_scans(const fs::path& folder, const std::vector<std::string>& patterns) {
  std::set<fs::path> found;
  for (const std::string& pattern : patterns) {
    std::set<fs::path> of_this;
    const fs::path path(pattern);
    match(folder, path.is_absolute() ? fs::path("/") : fs::path(), parts_of(path.relative_path()), 0, 0, of_this);
    if (of_this.empty()) {
      throw Error(is_pattern(pattern) ? "no recording matches '" + printable(pattern, 200) + "'"
                                      : printable(pattern, 200) + ": not a recording: recording.json is missing");
    }
    found.merge(of_this);
  }
  std::vector<BatchScan> out;
  out.reserve(found.size());
  std::set<fs::path> places;
  for (const fs::path& path : found) {
    // Patterns may find one by a relative path and by an absolute one.
    if (!places.insert(fs::absolute(folder / path / ".").lexically_normal()).second) continue;
    out.push_back({"", path.empty() ? std::string(".") : path.string()});
  }
  name_scans(folder, out);
  std::sort(out.begin(), out.end(), [](const BatchScan& a, const BatchScan& b) { return a.name < b.name; });
  std::set<std::string> names, files;
  for (const BatchScan& scan : out) {
    for (std::size_t slash = scan.name.find('/'); slash != std::string::npos; slash = scan.name.find('/', slash + 1)) {
      if (names.contains(scan.name.substr(0, slash)))
        throw Error("the recording '" + printable(scan.name) + "' is inside another recording of the batch");
    }
    if (!files.insert(flat_name(scan.name)).second)
      throw Error("two recordings would be called '" + printable(flat_name(scan.name)) + "'");
    names.insert(scan.name);
  }
  return out;
}

std::string flat_name(const std::string& name) {
  std::string out = name;
  std::replace(out.begin(), out.end(), '/', '-');
  return out;
}

}  // namespace asperity
