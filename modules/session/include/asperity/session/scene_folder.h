#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/pipeline/earlier_scene.h"

namespace asperity {

// The folder of a scene, to be replaced as a whole by one in which the scene has more or less. What asperity has not
// written into it is kept.
class SceneFolder {
 public:
  // Throws Error if asperity has not written the folder, if it is the current one, or if it cannot be replaced.
  explicit SceneFolder(const EarlierScene& earlier);

  const std::filesystem::path& path() const { return folder_.path(); }
  // True if a files.json is in the folder: it is to be written again.
  bool has_listing() const { return has_listing_; }

  // Gives what was kept, by relative paths. Throws Error if the scene was changed since it was read: then nothing is
  // replaced.
  std::vector<std::filesystem::path> commit();

 private:
  std::filesystem::path target_;
  std::string scene_;
  std::string checksum_;
  bool has_listing_ = false;
  std::set<std::string> ours_;
  OutputFolder folder_;
};

}  // namespace asperity
