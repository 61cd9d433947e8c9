#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity::studio {

enum class EntryKind { kRecording, kScene, kMesh, kTexture, kResult, kImage, kStudy, kStudyLog, kTable, kSurface };

// Something in the project's folder that the studio can open.
struct Entry {
  EntryKind kind;
  std::string name;  // relative to the folder, with /
};

// True if something has this name, a link too. Throws Error if that cannot be looked up: what has the name could be
// replaced.
bool is_taken(const std::filesystem::path& path);

// The folder that the studio works in. A browser names files only relative to it, and gets at nothing outside.
class Project {
 public:
  // Throws Error if it is not a folder.
  explicit Project(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }

  // What is there, sorted by name, three folders deep, at most 10,000 entries of 100,000 files; hidden ones are left
  // out, links are not followed.
  std::vector<Entry> entries() const;

  // The path of something that exists. Throws Error naming it for an absolute name, one with `..`, one that is not
  // UTF-8, is hidden or leads through a link out of the folder, one that does not exist, and a folder in which a .json
  // or .csv is a link that leads out.
  std::filesystem::path existing(const std::string& name) const;
  // The path of something to be written: as above, but it need not exist; its parent must.
  std::filesystem::path writable(const std::string& name) const;
  // A free name like "scan", "scan_2", … in the folder, or "feel.csv", "feel_2.csv", …. Throws Error as is_taken().
  std::string free_name(const std::string& stem, const std::string& extension = {}) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace asperity::studio
