#include "stream_fifo.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

StreamFifo::StreamFifo(std::filesystem::path path) : path_(std::move(path)) {
  if (::mkfifo(path_.c_str(), 0600) != 0)
    throw Error(printable(path_.string(), 200) + ": a FIFO cannot be made: " + std::strerror(errno));
}

StreamFifo::~StreamFifo() {
  close();
  ::unlink(path_.c_str());
}

bool StreamFifo::open(bool& is_new) {
  is_new = false;
  if (file_ >= 0) return true;
  file_ = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) {
    if (errno == ENXIO || errno == EINTR) return false;
    throw Error(printable(path_.string(), 200) + ": cannot be opened: " + std::strerror(errno));
  }
  constexpr int kBuffer_bytes = 1 << 20;  // three images; the system may allow less
  ::fcntl(file_, F_SETPIPE_SZ, kBuffer_bytes);
  is_new = true;
  return true;
}

std::size_t StreamFifo::write(std::span<const char> bytes, int timeout_ms) {
  if (file_ < 0) return 0;
  pollfd state{file_, POLLOUT, 0};
  if (::poll(&state, 1, timeout_ms) <= 0) return 0;
  if ((state.revents & POLLERR) != 0) {
    close();
    return 0;
  }
  const ssize_t taken = ::write(file_, bytes.data(), bytes.size());
  if (taken >= 0) return static_cast<std::size_t>(taken);
  if (errno != EAGAIN && errno != EINTR) close();
  return 0;
}

void StreamFifo::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

}  // namespace asperity
