#include "asperity/session/our_folder.h"

#include <set>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace fs = std::filesystem;
namespace {

constexpr const char* kListing = "files.json";

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) out.insert(fs::relative(entry.path(), folder).generic_string());
  }
  return out;
}

}  // namespace

void write_listing(const fs::path& folder) {
  Json out;
  out["format"] = "asperity-files";
  out["version"] = 1;
  out["files"] = files_in(folder);
  write_file(folder / kListing, out.dump_repaired(2) + "\n");
}

FolderContent is_our_folder(const fs::path& folder) {
  try {
    const Json listing = parse_json(read_file(folder / kListing, std::uint64_t{1} << 20));
    if (listing.at("format") != "asperity-files") return false;
    std::set<std::string> ours{kListing};
    for (const Json& name : listing.at("files")) ours.insert(name.get<std::string>());
    for (const std::string& name : files_in(folder)) {
      if (!ours.contains(name)) return FolderContent::with_added(name);
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace asperity
