#include "asperity/base/sync_folder.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"

namespace asperity {

void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!done && error != EINVAL)
    throw Error(folder.string() + ": cannot be forced to the disk: " + std::strerror(error));
}

}  // namespace asperity
