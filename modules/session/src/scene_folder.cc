#include "asperity/session/scene_folder.h"

#include <algorithm>
#include <set>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::set<std::string> replaceable_files(const EarlierScene& earlier) {
  const std::string name = printable(earlier.given.string(), 200);
  if (!earlier.files.contains(earlier.file)) {
    throw Error(name + ": was not written by asperity (neither its files.json nor its registration.json lists " +
                printable(earlier.file, 200) + "); nothing was changed. Write the scene into another folder with -o");
  }
  std::error_code error;
  if (fs::equivalent(earlier.folder, fs::current_path(error), error))
    throw Error(name +
                ": is the current folder, which would be replaced as a whole; nothing was changed. Run the "
                "command from another folder");
  std::set<std::string> out = earlier.files;
  out.insert(earlier.own_files.begin(), earlier.own_files.end());
  return out;
}

// Gives what is in a folder and not ours a second name in the new one: no moment is without it, not even one of a power
// cut. Gives the names.
std::vector<fs::path> keep_strangers(const fs::path& folder, const std::set<std::string>& ours, const fs::path& to) {
  std::vector<fs::path> kept;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (ours.contains(name.generic_string()) || (entry.is_directory() && !entry.is_symlink())) continue;
    fs::path place = to / name;
    for (int k = 1; fs::exists(fs::symlink_status(place)); ++k)
      place = to / (name.string() + ".kept-" + std::to_string(k));
    fs::create_directories(place.parent_path());
    std::error_code error;
    if (entry.is_symlink()) {
      fs::copy_symlink(entry.path(), place, error);
    } else {
      fs::create_hard_link(entry.path(), place, error);
      if (error && entry.is_regular_file()) fs::copy_file(entry.path(), place, error);
    }
    if (error) {
      throw Error(printable(entry.path().string(), 200) +
                  ": is not a file of asperity and cannot be kept: " + error.message() + "; nothing was replaced");
    }
    kept.push_back(name);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

SceneFolder::SceneFolder(const EarlierScene& earlier)
    : target_(earlier.folder),
      scene_(earlier.file),
      checksum_(earlier.checksum),
      has_listing_(earlier.files.contains("files.json")),
      ours_(replaceable_files(earlier)),
      folder_(earlier.folder, [](const fs::path&) { return true; }) {}

std::vector<fs::path> SceneFolder::commit() {
  if (scene_checksum(target_, scene_) != checksum_) {
    throw Error(printable((target_ / scene_).string(), 200) +
                ": was changed since it was read; nothing was replaced. Run this again");
  }
  std::vector<fs::path> kept = keep_strangers(target_, ours_, folder_.path());
  for (fs::path& name : folder_.commit()) kept.push_back(std::move(name));
  return kept;
}

}  // namespace asperity
