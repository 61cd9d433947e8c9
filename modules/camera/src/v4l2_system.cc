#include "v4l2_system.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr unsigned kVideoMajor = 81;  // of Video4Linux in the kernel's list of devices

class KernelV4l2 final : public V4l2System {
 public:
  int open(const char* path) override {
    // Other devices may act on being opened.
    struct stat status {};
    if (::stat(path, &status) != 0) return -1;
    if (!S_ISCHR(status.st_mode) || major(status.st_rdev) != kVideoMajor) {
      errno = ENOTTY;
      return -1;
    }
    return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  void close(int file) override { ::close(file); }
  int ioctl(int file, unsigned long request, void* argument) override { return ::ioctl(file, request, argument); }
  void* map(int file, std::size_t length, std::int64_t offset) override {
    void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t length) override { ::munmap(memory, length); }
  int wait_readable(int file, int timeout_ms) override {
    pollfd wait{file, POLLIN, 0};
    return ::poll(&wait, 1, timeout_ms);
  }
};

}  // namespace

std::unique_ptr<V4l2System> make_v4l2_system() { return std::make_unique<KernelV4l2>(); }

V4l2Device::V4l2Device(const std::string& path, std::unique_ptr<V4l2System> system)
    : name_("v4l2:" + path), system_(std::move(system)), file_(system_->open(path.c_str())) {
  if (file_ >= 0) return;
  const int reason = errno;
  if (reason == ENOTTY) throw Error(name_ + ": is not a video device");
  if (reason == EBUSY) throw Error(name_ + ": is used by another program");
  throw Error(name_ + ": cannot be opened: " + std::strerror(reason));
}

V4l2Device::~V4l2Device() {
  if (file_ >= 0) system_->close(file_);
}

bool V4l2Device::call(unsigned long request, void* argument) const {
  for (;;) {
    if (system_->ioctl(file_, request, argument) == 0) return true;
    if (errno != EINTR) return false;
  }
}

}  // namespace asperity
