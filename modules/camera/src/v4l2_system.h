#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "asperity/camera/camera_source.h"
#include "asperity/camera/open_v4l2.h"

namespace asperity {

// The calls to the kernel that a camera needs, each failing as its namesake does: −1 (nullptr for map) and errno.
class V4l2System {
 public:
  virtual ~V4l2System() = default;
  virtual int open(const char* path) = 0;  // ENOTTY for what is no video device
  virtual void close(int file) = 0;
  virtual int ioctl(int file, unsigned long request, void* argument) = 0;
  virtual void* map(int file, std::size_t length, std::int64_t offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  virtual int wait_readable(int file, int timeout_ms) = 0;  // poll: 0 if the time is over
};

std::unique_ptr<V4l2System> make_v4l2_system();

std::unique_ptr<CameraSource> open_v4l2(const std::string& device, const V4l2Config& config,
                                        std::unique_ptr<V4l2System> system);

// An open device; its methods repeat calls that a signal has interrupted.
class V4l2Device {
 public:
  V4l2Device(const std::string& path, std::unique_ptr<V4l2System> system);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  // True if it was done; else errno says why not.
  template <class Argument>
  bool ask(unsigned long request, Argument& argument) const {
    return call(request, &argument);
  }
  void* map(std::size_t length, std::int64_t offset) const { return system_->map(file_, length, offset); }
  void unmap(void* memory, std::size_t length) const { system_->unmap(memory, length); }
  int wait_readable(int timeout_ms) const { return system_->wait_readable(file_, timeout_ms); }
  const std::string& name() const { return name_; }

 private:
  bool call(unsigned long request, void* argument) const;

  std::string name_;
  std::unique_ptr<V4l2System> system_;
  int file_ = -1;
};

}  // namespace asperity
