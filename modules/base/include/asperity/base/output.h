#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Writes `content` under a temporary name next to `path` and renames it there. Throws Error; on any
// failure `path` is as it was. The content is on disk before the rename, unless the file is part of an
// unfinished OutputFolder: what is in those can be made again.
void write_file(const std::filesystem::path& path, std::string_view content);

// A file written piece by piece, like write_file as a whole or not at all: pieces go to a temporary name next to the
// target, and commit() puts them in its place. Without commit() nothing remains.
class OutputFile {
 public:
  // Throws Error if its folder cannot be written, or if the target is a folder, a device or a pipe.
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throws Error if the disk takes no more.
  void append(std::string_view content);
  void commit();

 private:
  void close() noexcept;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int file_ = -1;
};

// A folder written as a whole: files go into path(), a temporary folder next to the target, and
// commit() puts it in the target's place by rename. Without commit() nothing remains.
class OutputFolder {
 public:
  // Throws Error if the target exists and `is_ours(target)` is false, or if its parent cannot be written.
  // An empty folder counts as ours.
  OutputFolder(std::filesystem::path target, const std::function<bool(const std::filesystem::path&)>& is_ours);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }

  // All is on the disk before what it replaces goes. Files that came into the target since the constructor are kept:
  // they are in the new folder, by their names or, where it has such a one, with ".kept-1" behind it. Gives their
  // relative paths.
  std::vector<std::filesystem::path> commit();

 private:
  std::vector<std::filesystem::path> keep_strangers(const std::filesystem::path& old) const;
  void sync_name(const std::string& besides = {}) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::set<std::filesystem::path> known_;  // in the target when this began
};

// Notes that something stands at `path` whatever comes: commit() does so, and who writes in place.
void note_output(const std::filesystem::path& path);

// What was put in place by now, the first three by name; empty if nothing was.
std::string outputs_in_place();

// Removes the temporary files and folders that are in use now. Called when the program is stopped by a signal, just
// before it ends: from then on commit() waits for that end. Not safe inside the handler itself.
void remove_unfinished_output();

}  // namespace asperity
