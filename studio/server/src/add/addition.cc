#include "add/addition.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "asperity/base/inner_path.h"
#include "asperity/base/sync_folder.h"
#include "asperity/base/text.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestPart_bytes = 255;

Advice refused(const std::string& path, const std::string& why) {
  return {printable(path, 200) + ": " + why, "Nothing was added. Rename the file, or leave it out."};
}

void check_path(const std::string& path) {
  if (!is_utf8(path) || printable(path, path.size() + 1) != path) throw refused(path, "this name cannot be shown");
  if (!inner_path(path) || path.find('\\') != std::string::npos)
    throw refused(path, "this is not a path inside a folder");
  std::size_t parts = 0;
  for (const fs::path& part : fs::path(path)) {
    const std::string name = part.string();
    if (name.empty() || name.front() == '.') throw refused(path, "hidden files and folders are not added");
    if (name.size() > kLongestPart_bytes) throw refused(path, "this name is longer than 255 bytes");
    if (++parts > kDeepestAdded) throw refused(path, "it is more than 8 folders deep");
  }
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string gigabytes(std::uint64_t bytes) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  std::array<char, 32> out{};
  std::snprintf(out.data(), out.size(), "%.1f GiB", static_cast<double>(bytes) / kGiB);
  return out.data();
}

std::uint64_t sum_bytes(const std::vector<AddedFile>& files) {
  std::uint64_t out = 0;
  for (const AddedFile& file : files) out += std::min(file.bytes, kMostAddedBytes + 1);  // no overflow: 2000 of them
  return out;
}

class OpenedFile {
 public:
  OpenedFile(const fs::path& path, int flags) : path_(path), file_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw Error(printable(path.string(), 200) + ": " + std::strerror(errno));
  }
  ~OpenedFile() { ::close(file_); }
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;

  void write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) throw Error(printable(path_.filename().string(), 200) + ": " + std::strerror(errno));
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void sync() const {
    if (::fsync(file_) != 0) throw Error(printable(path_.filename().string(), 200) + ": " + std::strerror(errno));
  }

 private:
  fs::path path_;
  int file_;
};

// False: there is something already.
bool move_to_free(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  // Not all file systems know of it.
  std::error_code error;
  if (errno == EINVAL && !fs::exists(fs::symlink_status(to, error))) {
    fs::rename(from, to, error);
    if (!error) return true;
    errno = error.value();
  }
  throw Error(printable(to.string(), 200) + ": " + std::strerror(errno));
}

}  // namespace

void check_added_files(const std::vector<AddedFile>& files) {
  if (files.empty()) throw Advice("no file was chosen", "Choose a file, or a folder that is not empty.");
  if (files.size() > kMostAddedFiles) {
    throw Advice("these are " + std::to_string(files.size()) + " files; at most 2000 are added at once",
                 "Add the folders one by one, or copy them into the project's folder.");
  }
  if (sum_bytes(files) > kMostAddedBytes) {
    throw Advice("these files are larger than " + gigabytes(kMostAddedBytes) + " together",
                 "Copy them into the project's folder; the studio finds them there.");
  }
  std::set<std::string> names, folders;
  for (const AddedFile& file : files) {
    check_path(file.path);
    if (!names.insert(lower_case(file.path)).second) throw refused(file.path, "it is given twice");
    for (fs::path above = fs::path(file.path).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(lower_case(above.string()));
  }
  for (const AddedFile& file : files) {
    if (folders.contains(lower_case(file.path))) throw refused(file.path, "it is both a file and a folder");
  }
}

Addition::Addition(const Project& project, std::vector<AddedFile> files)
    : project_(project), folder_((check_added_files(files), project.folder())), files_(std::move(files)) {
  std::error_code error;
  const fs::space_info room = fs::space(project_.folder(), error);
  if (!error && room.available < sum_bytes(files_)) {
    throw Advice(
        "the disk has room for " + gigabytes(room.available) + ", and these files are " + gigabytes(sum_bytes(files_)),
        "Free some space, and add them again.");
  }
  for (const AddedFile& file : files_) {
    const fs::path parent = (folder_.path() / file.path).parent_path();
    fs::create_directories(parent, error);
    if (error) throw Error(printable(file.path, 200) + ": its folder cannot be made: " + error.message());
  }
  begin_files();
}

// Makes the current file, and all after it that are empty.
void Addition::begin_files() {
  for (; current_ < files_.size(); ++current_) {
    const OpenedFile file(folder_.path() / files_[current_].path, O_WRONLY | O_CREAT | O_EXCL);
    if (files_[current_].bytes > 0) return;
    file.sync();
  }
}

void Addition::append(std::size_t file, std::uint64_t at, std::string_view bytes) {
  if (file != current_ || current_ >= files_.size() || at != taken_) {
    throw Error("these bytes are not the next ones: they are of file " + std::to_string(file) + " at " +
                std::to_string(at) + ", where file " + std::to_string(current_) + " at " + std::to_string(taken_) +
                " was expected");
  }
  const AddedFile& of = files_[current_];
  if (bytes.size() > of.bytes - taken_) throw Error(printable(of.path, 200) + ": it is longer than announced");
  const OpenedFile out(folder_.path() / of.path, O_WRONLY | O_APPEND);
  out.write(bytes);
  taken_ += bytes.size();
  if (taken_ < of.bytes) return;
  out.sync();
  ++current_;
  taken_ = 0;
  begin_files();
}

std::vector<Addition::Placed> Addition::commit() {
  if (current_ < files_.size()) throw Error(printable(files_[current_].path, 200) + ": it has not arrived completely");
  std::map<std::string, bool> tops;  // in order; true: a folder
  for (const AddedFile& file : files_) {
    const fs::path path(file.path);
    tops[path.begin()->string()] = std::next(path.begin()) != path.end();
  }
  for (const auto& [name, is_folder] : tops) {
    if (!is_folder) continue;
    for (const auto& inner : fs::recursive_directory_iterator(folder_.path() / name)) {
      if (inner.is_directory()) sync_folder(inner.path());
    }
    sync_folder(folder_.path() / name);
  }
  std::vector<Placed> out;
  for (const auto& [name, is_folder] : tops) {
    const std::size_t ending = is_folder ? name.size() : std::min(name.find('.', 1), name.size());
    std::string free = name;
    while (!move_to_free(folder_.path() / name, project_.folder() / free))
      free = project_.free_name(name.substr(0, ending), name.substr(ending));
    out.push_back({name, free});
  }
  sync_folder(project_.folder());
  return out;
}

}  // namespace asperity::studio
