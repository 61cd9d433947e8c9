#include "asperity/transport/open_path.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

class PathSource : public ByteSource {
 public:
  explicit PathSource(const std::string& path) : path_(path) {
    file_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file_ < 0) throw Error(name() + ": cannot be opened: " + std::strerror(errno));
    struct stat status {};
    if (::fstat(file_, &status) != 0 || !(S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode))) {
      ::close(file_);
      throw Error(name() + ": is neither a file nor a pipe");
    }
    is_pipe_ = S_ISFIFO(status.st_mode);
  }
  ~PathSource() override { ::close(file_); }
  PathSource(const PathSource&) = delete;
  PathSource& operator=(const PathSource&) = delete;

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    pollfd wait{file_, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(timeout.count()));
    if (ready < 0 && errno != EINTR) throw Error(name() + ": cannot be read: " + std::strerror(errno));
    if (ready <= 0) return {};
    const ssize_t count = ::read(file_, into.data(), into.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return {};
    if (count < 0) throw Error(name() + ": cannot be read: " + std::strerror(errno));
    if (count == 0) throw LinkLost(name() + (is_pipe_ ? ": its writer has gone" : ": at its end"));
    return {static_cast<std::size_t>(count), host_now_ns()};
  }

  bool write(std::span<const std::uint8_t>) override { return false; }
  std::string name() const override { return printable(path_, 200); }

 private:
  std::string path_;
  int file_ = -1;
  bool is_pipe_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> open_path(const std::string& path) { return std::make_unique<PathSource>(path); }

}  // namespace asperity
