#include "asperity/base/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>

#include "asperity/base/error.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::mutex unfinished_mutex;
std::set<fs::path> unfinished;

void mark_unfinished(const fs::path& path) {
  const std::lock_guard lock(unfinished_mutex);
  unfinished.insert(path);
}

void mark_finished(const fs::path& path) {
  const std::lock_guard lock(unfinished_mutex);
  unfinished.erase(path);
}

// True if `path` lies in a folder that is still being written.
bool is_in_unfinished_folder(const fs::path& path) {
  const std::lock_guard lock(unfinished_mutex);
  for (fs::path folder = path.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (unfinished.contains(folder)) return true;
  }
  return false;
}

std::string template_beside(const fs::path& path) {
  fs::path name = path.filename();
  return (path.parent_path() / ("." + name.string() + ".tmp-XXXXXX")).string();
}

std::string reason() { return std::strerror(errno); }

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  OutputFile file(path);
  file.append(content);
  file.commit();
}

OutputFile::OutputFile(fs::path target) : target_(std::move(target)), temporary_(template_beside(target_)) {
  // A rename would put a file in the place of a device, for those who may.
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(target_.string() + ": cannot be written: it exists and is no file that could be replaced");
  }
  file_ = ::mkstemp(temporary_.data());
  if (file_ < 0) throw Error(target_.string() + ": cannot be written: " + reason());
  mark_unfinished(temporary_);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file_, 0666 & ~mask);
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
  if ((!is_in_unfinished_folder(target_) && ::fsync(file_) != 0) ||
      ::rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw Error(target_.string() + ": cannot be written: " + reason());
  }
  close();
}

OutputFolder::OutputFolder(fs::path target, const std::function<bool(const fs::path&)>& is_ours)
    : target_(std::move(target)) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (target_.empty()) throw Error("the output folder has no name");
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!fs::is_directory(target_)) throw Error(target_.string() + ": exists and is not a folder");
    if (!fs::is_empty(target_) && !is_ours(target_)) {
      throw Error(target_.string() + ": exists and was not written by asperity; nothing was changed");
    }
  }
  if (target_.has_parent_path()) {
    fs::create_directories(target_.parent_path(), error);
    if (error) throw Error(target_.string() + ": cannot be made: " + error.message());
  }
  std::string temporary = template_beside(target_);
  if (::mkdtemp(temporary.data()) == nullptr) throw Error(target_.string() + ": cannot be made: " + reason());
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(temporary.c_str(), 0777 & ~mask);
  temporary_ = temporary;
  mark_unfinished(temporary_);
}

OutputFolder::~OutputFolder() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  mark_finished(temporary_);
}

void OutputFolder::commit() {
  std::error_code ignored;
  if (fs::exists(target_, ignored)) {
    // Exchanging the two names leaves no moment without a whole folder in place.
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
      fs::path old = temporary_;
      old += ".old";
      if (::rename(target_.c_str(), old.c_str()) != 0 || ::rename(temporary_.c_str(), target_.c_str()) != 0) {
        const std::string why = reason();
        ::rename(old.c_str(), target_.c_str());
        throw Error(target_.string() + ": cannot be replaced: " + why);
      }
      fs::remove_all(old, ignored);
    } else {
      fs::remove_all(temporary_, ignored);
    }
  } else if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw Error(target_.string() + ": cannot be written: " + reason());
  }
  mark_finished(temporary_);
  temporary_.clear();
}

void remove_unfinished_output() {
  const std::lock_guard lock(unfinished_mutex);
  std::error_code ignored;
  for (const auto& path : unfinished) fs::remove_all(path, ignored);
  unfinished.clear();
}

}  // namespace asperity
