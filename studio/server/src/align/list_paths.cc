#include "align/list_paths.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "asperity/base/text.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 2;  // below the folder's own level
constexpr int kMostFiles = 1000;
constexpr std::size_t kLongestHead = 4096;

// Whether the first line that is not a comment names a path's columns.
bool has_path_columns(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(kLongestHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  std::size_t begin = 0;
  while (begin < head.size() && (head[begin] == '#' || head[begin] == '\n' || head[begin] == '\r')) {
    const std::size_t end = head.find('\n', begin);
    begin = end == std::string::npos ? head.size() : end + 1;
  }
  const std::string line = "," + head.substr(begin, head.find_first_of("\r\n", begin) - begin) + ",";
  return line.find(",px_m,") != std::string::npos && line.find(",py_m,") != std::string::npos &&
         line.find(",pz_m,") != std::string::npos;
}

}  // namespace

Json list_paths(const Project& project) {
  std::vector<std::pair<std::string, const char*>> found;
  for (const Entry& entry : project.entries()) {
    if (entry.kind == EntryKind::kRecording) found.emplace_back(entry.name, "recording");
  }
  std::error_code error;
  int files = 0;
  for (fs::recursive_directory_iterator at(project.folder(), fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && files < kMostFiles; at.increment(error)) {
    const std::string leaf = at->path().filename().string();
    const std::string name = at->path().lexically_relative(project.folder()).generic_string();
    if (at->is_directory(error)) {
      const bool whole = fs::exists(at->path() / "recording.json", error);
      if (leaf.starts_with('.') || whole || at->is_symlink(error) || at.depth() >= kDeepest) {
        at.disable_recursion_pending();
      }
    } else if (leaf.ends_with(".csv") && is_utf8(name) && at->is_regular_file(error) && !at->is_symlink(error)) {
      ++files;
      if (has_path_columns(at->path())) found.emplace_back(name, "path");
    }
  }
  std::sort(found.begin(), found.end());
  Json out = Json::array();
  for (const auto& [name, kind] : found) {
    Json each;
    each["kind"] = kind;
    each["name"] = name;
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace asperity::studio
