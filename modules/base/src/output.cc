#include "asperity/base/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <random>
#include <set>

#include "asperity/base/error.h"
#include "unfinished_output.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::string reason() { return std::strerror(errno); }

// A name of our own beside `path`: `make` is tried until it does not fail with EEXIST. Throws Error for what else
// fails.
template <class Make>
fs::path make_beside(const fs::path& path, const char* what, const Make& make) {
  constexpr int kTries = 1000;
  std::random_device random;
  for (int k = 0; k < kTries; ++k) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", random());
    fs::path name = path.parent_path() / ("." + path.filename().string() + ".tmp-" + digits.data());
    mark_unfinished(name);  // before it is there, or a signal could come in between
    if (make(name)) return name;
    const int error = errno;
    mark_finished(name);
    errno = error;
    if (errno != EEXIST) break;
  }
  throw Error(path.string() + ": cannot be " + what + ": " + reason());
}

// Forces a file, or a folder's list of names, to the disk; 0 or the error.
int try_sync(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  // Some file systems cannot sync a folder; they then need not.
  return done || (error == EINVAL && fs::is_directory(path)) ? 0 : error;
}

// The same of what is still to be put in place. Throws Error naming `target`.
void sync(const fs::path& path, const fs::path& target) {
  if (const int error = try_sync(path); error != 0)
    throw Error(target.string() + ": cannot be written: " + std::strerror(error));
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// All files and folders below `folder`, by their relative paths; with an error, those before it.
std::set<fs::path> names_in(const fs::path& folder, std::error_code& error) {
  std::set<fs::path> out;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    out.insert(entry->path().lexically_relative(folder));
  }
  return out;
}

// Puts a folder where there is none; `temporary` is then empty. Throws Error.
void place(fs::path& temporary, const fs::path& target, OutputNote& note) {
  {
    const PlacingLock lock;
    if (::rename(temporary.c_str(), target.c_str()) == 0) {
      lock.end(temporary, &note);
      temporary.clear();
      return;
    }
  }
  throw Error(target.string() + ": cannot be written: " + reason());
}

// Puts a folder in the place of another; `temporary` is then empty. Gives the name that the other has then. Throws
// Error.
fs::path exchange(fs::path& temporary, const fs::path& target, OutputNote& note) {
  fs::path exchanged = temporary;
  fs::path moved = temporary;
  moved += ".old";
  bool is_lost = false;
  int error = 0;
  {
    const PlacingLock lock;
    // Exchanging the two names leaves no moment without a whole folder in place.
    if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) {
      lock.end(temporary, &note);
      temporary.clear();
      return exchanged;
    }
    // Some file systems cannot (NFS, vfat, many of FUSE). Between these two renames nothing has the target's name
    // (docs/crashes.md).
    const bool is_moved = ::rename(target.c_str(), moved.c_str()) == 0;
    if (is_moved && ::rename(temporary.c_str(), target.c_str()) == 0) {
      lock.end(temporary, &note);
      temporary.clear();
      return moved;
    }
    error = errno;
    is_lost = is_moved && ::rename(moved.c_str(), target.c_str()) != 0;
  }
  std::string text = target.string() + ": cannot be replaced: " + std::strerror(error);
  if (is_lost) text += "; what was there is whole in " + moved.string() + " and can be renamed back";
  throw Error(text);
}

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  OutputFile file(path);
  file.append(content);
  file.commit();
}

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  // A rename would put a file in the place of a device, for those who may.
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(
        target_.string() +
        ": cannot be written: it exists and is not a regular file, so that it cannot be replaced; choose another name");
  }
  temporary_ = make_beside(target_, "written", [this](const fs::path& name) {
    file_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return file_ >= 0;
  });
}

OutputFile::~OutputFile() {
  if (file_ < 0) return;
  ::unlink(temporary_.c_str());
  close();
}

void OutputFile::close() noexcept {
  ::close(file_);
  file_ = -1;
  mark_finished(temporary_);
}

void OutputFile::append(std::string_view content) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t count = ::write(file_, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(target_.string() + ": cannot be written: " + reason());
    done += static_cast<std::size_t>(count);
  }
}

void OutputFile::commit() {
  // Forcing a file of a whole folder to disk would protect nothing before the folder is renamed, and waits
  // for whatever else the machine is writing.
  const bool alone = !is_in_unfinished_folder(target_);
  OutputNote note(target_);
  bool placed = !alone || ::fsync(file_) == 0;
  if (placed) {
    const PlacingLock lock;
    placed = ::rename(temporary_.c_str(), target_.c_str()) == 0;
    if (placed) lock.end(temporary_, alone ? &note : nullptr);
  }
  if (!placed) throw Error(target_.string() + ": cannot be written: " + reason());
  close();
  if (!alone) return;
  if (const int error = try_sync(folder_of(target_)); error != 0)
    throw Error(target_.string() + ": is written, but cannot be forced to the disk: " + std::strerror(error));
}

OutputFolder::OutputFolder(fs::path target, const std::function<bool(const fs::path&)>& is_ours)
    : target_(std::move(target)) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (target_.empty()) throw Error("the output folder has no name");
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!fs::is_directory(target_)) throw Error(target_.string() + ": exists and is not a folder");
    if (!fs::is_empty(target_) && !is_ours(target_)) {
      throw Error(target_.string() +
                  ": exists and was not written by asperity; nothing was changed. Choose another output folder");
    }
    known_ = names_in(target_, error);
    // All that is not known would be taken for what others have put there meanwhile.
    if (error) throw Error(target_.string() + ": cannot be read: " + error.message() + "; nothing was changed");
  }
  if (target_.has_parent_path()) {
    fs::create_directories(target_.parent_path(), error);
    if (error) throw Error(target_.string() + ": cannot be made: " + error.message());
  }
  temporary_ = make_beside(target_, "made", [](const fs::path& name) { return ::mkdir(name.c_str(), 0777) == 0; });
}

OutputFolder::~OutputFolder() {
  if (temporary_.empty()) return;
  try {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  } catch (const std::bad_alloc&) {
    // It stays, under a name that says what it is.
  }
  mark_finished(temporary_);
}

std::vector<fs::path> OutputFolder::commit() {
  OutputNote note(target_);
  // What gets the name must be whole on the disk before, or a power cut leaves the name with half of it.
  std::error_code unread;
  const std::set<fs::path> names = names_in(temporary_, unread);
  if (unread) {
    throw Error(target_.string() + ": cannot be written: what is to be put there cannot be read: " + unread.message());
  }
  for (const fs::path& name : names) sync(temporary_ / name, target_);
  sync(temporary_, target_);
  std::error_code ignored;
  if (!fs::exists(target_, ignored)) {
    place(temporary_, target_, note);
    sync_name();
    return {};
  }
  // Made before, as the note is.
  const Error no_memory(target_.string() + ": is written, but there is not enough memory to remove what it replaced; " +
                        "the name of its folder begins with " + temporary_.string());
  const fs::path old = exchange(temporary_, target_, note);
  try {
    sync_name("; what it replaced is kept in " + old.string());
    std::vector<fs::path> kept = keep_strangers(old);
    std::error_code unremoved;
    fs::remove_all(old, unremoved);
    if (unremoved) {
      throw Error(target_.string() + ": is written, but what it replaced cannot be removed: " + unremoved.message() +
                  "; what is left of it is in " + old.string());
    }
    return kept;
  } catch (const std::bad_alloc&) {
    throw no_memory;
  }
}

// The name that the folder has now, and what was kept in it, on the disk.
void OutputFolder::sync_name(const std::string& besides) const {
  if (const int error = try_sync(folder_of(target_)); error != 0) {
    throw Error(target_.string() + ": is written, but cannot be forced to the disk: " + std::strerror(error) + besides);
  }
}

// Moves what came into the folder since we looked at it into the one that has taken its place.
std::vector<fs::path> OutputFolder::keep_strangers(const fs::path& old) const {
  std::vector<fs::path> kept;
  std::error_code unread;
  const std::set<fs::path> names = names_in(old, unread);
  if (unread) {
    throw Error(target_.string() + ": is written, but what it replaced cannot be read: " + unread.message() +
                "; it is kept in " + old.string());
  }
  for (const fs::path& name : names) {
    // What lies in a folder that is moved goes with it.
    const bool moved =
        !kept.empty() &&
        std::mismatch(kept.back().begin(), kept.back().end(), name.begin(), name.end()).first == kept.back().end();
    if (known_.contains(name) || moved) continue;
    fs::path place = target_ / name;
    std::error_code error;
    for (int k = 1; fs::exists(fs::symlink_status(place, error)); ++k) {
      place = target_ / (name.string() + ".kept-" + std::to_string(k));
    }
    fs::create_directories(place.parent_path(), error);
    if (::rename((old / name).c_str(), place.c_str()) != 0) {
      throw Error(target_.string() + ": was written, but " + (old / name).string() +
                  " was put there meanwhile and cannot be moved: " + reason() + "; it is kept where it is");
    }
    sync(place.parent_path(), target_);  // before its old folder goes
    kept.push_back(name);
  }
  return kept;
}

}  // namespace asperity
