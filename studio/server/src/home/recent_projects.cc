#include "home/recent_projects.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/studio.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestFile_bytes = 1U << 20U;
constexpr int kHighestPort = 65535;

bool is_project(const Json& one) {
  return one.is_object() && one.contains("folder") && one["folder"].is_string() && one.contains("opened") &&
         one["opened"].is_string() && one.contains("port") && one["port"].is_number_unsigned() &&
         one["port"].get<std::uint64_t>() <= kHighestPort;
}

}  // namespace

fs::path recent_projects_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return fs::path(state) / "asperity" / "studio.json";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return fs::path(home) / ".local" / "state" / "asperity" / "studio.json";
}

std::vector<RecentProject> read_recent_projects(const fs::path& file) {
  std::vector<RecentProject> out;
  if (file.empty()) return out;
  try {
    const Json json = parse_json_or_null(read_file(file, kLargestFile_bytes));
    if (!json.is_object() || !json.contains("projects") || !json["projects"].is_array()) return out;
    for (const Json& one : json["projects"]) {
      if (!is_project(one) || out.size() >= kMostRecentProjects) continue;
      out.push_back({one["folder"].get<std::string>(), one["opened"].get<std::string>(), one["port"].get<int>()});
    }
  } catch (const Error&) {
    out.clear();
  }
  return out;
}

void add_recent_project(const fs::path& file, const RecentProject& project) {
  if (file.empty() || !is_utf8(project.folder)) return;
  std::vector<RecentProject> all = read_recent_projects(file);
  std::erase_if(all, [&](const RecentProject& one) { return one.folder == project.folder; });
  all.insert(all.begin(), project);
  if (all.size() > kMostRecentProjects) all.resize(kMostRecentProjects);
  Json out = Json::object();
  out["projects"] = Json::array();
  for (const RecentProject& one : all) {
    Json each = Json::object();
    each["folder"] = one.folder;
    each["opened"] = one.opened;
    each["port"] = one.port;
    out["projects"].push_back(std::move(each));
  }
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw Error(printable(file.parent_path().string(), 200) + ": cannot be made: " + error.message());
  write_file(file, out.dump_repaired(2) + '\n');
}

int remembered_port(const fs::path& file, const std::string& folder) {
  for (const RecentProject& one : read_recent_projects(file)) {
    if (one.folder == folder) return one.port;
  }
  return 0;
}

}  // namespace asperity::studio
