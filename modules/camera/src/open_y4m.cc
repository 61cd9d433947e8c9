#include "asperity/camera/open_y4m.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"
#include "y4m_source.h"

namespace asperity {

std::unique_ptr<CameraSource> open_y4m(const std::string& path) {
  const std::string name = "y4m:" + path;
  // Without O_NONBLOCK the opening of a FIFO would wait for its writer.
  OwnedFile file(path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                             : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) {
    throw Error(name + ": cannot be opened: " + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) throw Error(name + ": is a folder");
  return std::make_unique<Y4mSource>(std::move(file), name, S_ISREG(status.st_mode));
}

}  // namespace asperity
