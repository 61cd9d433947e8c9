#include "temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include "asperity/base/error.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = ".asperity-studio-";  // hidden: it may lie in a project
constexpr std::size_t kSuffix = 6;                    // of mkdtemp
constexpr const char* kMark = ".asperity-temporary";  // a folder of a person may have such a name by chance

// The folder's lock; -1: somebody else has it, it is not this user's, or no folder.
int take_lock(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return -1;
  struct stat about {};
  if (::fstat(file, &about) == 0 && about.st_uid == ::geteuid() && about.st_nlink > 0 &&
      ::flock(file, LOCK_EX | LOCK_NB) == 0) {
    return file;
  }
  ::close(file);
  return -1;
}

bool is_there(int file) {
  struct stat about {};
  return ::fstat(file, &about) == 0 && about.st_nlink > 0;
}

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& where) {
  // Another studio may take one for stale that is not locked yet.
  constexpr int kTrials = 20;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string name = (where / (kPrefix + std::string(kSuffix, 'X'))).string();
    if (::mkdtemp(name.data()) == nullptr) throw Error(name + ": a temporary folder cannot be made");
    lock_ = take_lock(name);
    path_ = name;
    if (lock_ >= 0 && is_there(lock_) && std::ofstream(path_ / kMark)) return;
    if (lock_ >= 0) ::close(lock_);
    ::rmdir(name.c_str());  // without its mark no sweep would take it away
  }
  throw Error(path_.string() + ": a temporary folder cannot be locked");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

void remove_stale_temporary_folders(const fs::path& where) noexcept {
  try {
    std::error_code error;
    for (fs::directory_iterator at(where, error), end; !error && at != end; at.increment(error)) {
      const std::string name = at->path().filename().string();
      if (!name.starts_with(kPrefix) || name.size() != std::string(kPrefix).size() + kSuffix) continue;
      const int lock = take_lock(at->path());
      if (lock < 0) continue;
      std::error_code ignored;
      if (fs::is_regular_file(fs::symlink_status(at->path() / kMark, ignored))) fs::remove_all(at->path(), ignored);
      ::close(lock);
    }
  } catch (const std::exception&) {
    // Without memory for the names they stay.
  }
}

}  // namespace asperity::studio
