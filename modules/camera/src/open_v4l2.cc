#include "asperity/camera/open_v4l2.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "asperity/base/host_clock.h"
#include "asperity/image/read_gray_image.h"
#include "asperity/transport/byte_source.h"
#include "v4l2_controls.h"
#include "v4l2_formats.h"
#include "v4l2_system.h"

namespace asperity {

namespace {

constexpr std::uint32_t kBuffers = 4;
constexpr std::size_t kLargestBuffer_bytes = std::size_t{512} << 20;
constexpr int kMostErrorsInARow = 100;
constexpr std::chrono::hours kLongestWait{1};

v4l2_buffer mapped_buffer(std::uint32_t index) {
  v4l2_buffer out{};
  out.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  out.memory = V4L2_MEMORY_MMAP;
  out.index = index;
  return out;
}

// The driver's memory for images; streaming while it lives.
class V4l2Buffers {
 public:
  explicit V4l2Buffers(const V4l2Device& device) : device_(device) {
    try {
      start();
    } catch (...) {
      stop();
      throw;
    }
  }
  ~V4l2Buffers() { stop(); }
  V4l2Buffers(const V4l2Buffers&) = delete;
  V4l2Buffers& operator=(const V4l2Buffers&) = delete;

  // What the driver wrote into the buffer; empty if that is not within its memory.
  std::span<const unsigned char> content(const v4l2_buffer& buffer) const {
    if (buffer.index >= mapped_.size() || buffer.bytesused > mapped_[buffer.index].second) return {};
    return {static_cast<const unsigned char*>(mapped_[buffer.index].first), buffer.bytesused};
  }

 private:
  void start() {
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    if (!device_.ask(VIDIOC_REQBUFS, request)) fail("no memory for its images");
    if (request.count < 2) throw Error(device_.name() + ": gives too few buffers");
    for (std::uint32_t index = 0; index < std::min(request.count, 4 * kBuffers); ++index) {
      v4l2_buffer buffer = mapped_buffer(index);
      if (!device_.ask(VIDIOC_QUERYBUF, buffer)) fail("no memory for its images");
      if (buffer.length < 1 || buffer.length > kLargestBuffer_bytes) {
        throw Error(fmt::format("{}: a buffer of {} bytes", device_.name(), buffer.length));
      }
      void* const memory = device_.map(buffer.length, buffer.m.offset);
      if (memory == nullptr) fail("no memory for its images");
      mapped_.emplace_back(memory, buffer.length);
      if (!device_.ask(VIDIOC_QBUF, buffer)) fail("does not take a buffer");
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device_.ask(VIDIOC_STREAMON, type)) fail("does not start");
  }

  void stop() {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    device_.ask(VIDIOC_STREAMOFF, type);
    for (const auto& [memory, length] : mapped_) device_.unmap(memory, length);
    mapped_.clear();
    v4l2_requestbuffers none{};
    none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    none.memory = V4L2_MEMORY_MMAP;
    device_.ask(VIDIOC_REQBUFS, none);
  }

  [[noreturn]] void fail(const char* what) const {
    const int reason = errno;
    if (reason == EBUSY) throw Error(device_.name() + ": is used by another program");
    throw Error(device_.name() + ": " + what + ": " + std::strerror(reason));
  }

  const V4l2Device& device_;
  std::vector<std::pair<void*, std::size_t>> mapped_;
};

void check_is_camera(const V4l2Device& device) {
  v4l2_capability has{};
  if (!device.ask(VIDIOC_QUERYCAP, has)) throw Error(device.name() + ": is not a video device");
  const std::uint32_t can = (has.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? has.device_caps : has.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    throw Error(device.name() + ": does not capture images (a camera often has a second device that does not)");
  }
  if ((can & V4L2_CAP_STREAMING) == 0) throw Error(device.name() + ": cannot share memory for its images");
}

// Every `step`-th byte from `first` on of each line: the luma. False if bytes are missing.
bool take_luma(std::span<const unsigned char> bytes, const V4l2Image& format, std::size_t first, std::size_t step,
               GrayImage& out) {
  const auto width = static_cast<std::size_t>(format.width), height = static_cast<std::size_t>(format.height);
  if (bytes.size() < format.bytes_per_line * (height - 1) + width * step) return false;
  out.width = format.width;
  out.height = format.height;
  out.pixels.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    const unsigned char* from = bytes.data() + row * format.bytes_per_line + first;
    std::uint8_t* to = out.pixels.data() + row * width;
    for (std::size_t column = 0; column < width; ++column) to[column] = from[column * step];
  }
  return true;
}

class V4l2Source final : public CameraSource {
 public:
  V4l2Source(const std::string& path, const V4l2Config& config, std::unique_ptr<V4l2System> system)
      : device_(path, std::move(system)),
        format_((check_is_camera(device_), agree_on_format(device_, config, warnings_))) {
    lock_controls(device_, config, format_, warnings_);
    buffers_ = std::make_unique<V4l2Buffers>(device_);
  }

  bool read(CameraFrame& frame, std::chrono::milliseconds timeout) override {
    const std::int64_t deadline_ns =
        host_now_ns() + std::chrono::nanoseconds(std::min<std::chrono::milliseconds>(timeout, kLongestWait)).count();
    for (;;) {
      const std::int64_t left_ns = std::max<std::int64_t>(deadline_ns - host_now_ns(), 0);
      const int ready = device_.wait_readable(static_cast<int>((left_ns + 999'999) / 1'000'000));
      if (ready < 0 && errno != EINTR) lost();
      if (ready > 0 && take(frame)) return true;
      if (host_now_ns() >= deadline_ns) return false;
    }
  }

  double nominal_rate_Hz() const override { return format_.rate_Hz; }
  std::string name() const override { return device_.name(); }
  std::vector<std::string> warnings() const override {
    std::vector<std::string> out = warnings_;
    if (stamped_by_us_) out.push_back("the driver's time stamps are of another clock: the time of arrival is used");
    if (damaged_ > 0) out.push_back(fmt::format("{} damaged images were passed over", damaged_));
    return out;
  }

 private:
  // Takes the oldest buffer that is full; false if it was none that can be used.
  bool take(CameraFrame& frame) {
    v4l2_buffer buffer = mapped_buffer(0);
    if (!device_.ask(VIDIOC_DQBUF, buffer)) {
      // EIO tells of a passing fault, such as a signal that is gone, or of one that does not pass; EAGAIN after poll
      // of a driver in disorder.
      if ((errno != EIO && errno != EAGAIN) || ++errors_ > kMostErrorsInARow) lost();
      return false;
    }
    errors_ = 0;
    const std::int64_t now_ns = host_now_ns();
    const bool good = (buffer.flags & V4L2_BUF_FLAG_ERROR) == 0 && convert(buffers_->content(buffer), frame.image);
    const bool monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    stamped_by_us_ = stamped_by_us_ || !monotonic;
    frame.t_ns = monotonic ? buffer.timestamp.tv_sec * 1'000'000'000LL + buffer.timestamp.tv_usec * 1000LL : now_ns;
    if (!device_.ask(VIDIOC_QBUF, buffer)) lost();
    if (!good || frame.t_ns <= last_ns_) {
      ++damaged_;
      return false;
    }
    last_ns_ = frame.t_ns;
    return true;
  }

  bool convert(std::span<const unsigned char> bytes, GrayImage& out) const {
    switch (format_.format) {
      case V4l2Format::kGrey:
        return take_luma(bytes, format_, 0, 1, out);
      case V4l2Format::kYuyv:
        return take_luma(bytes, format_, 0, 2, out);
      case V4l2Format::kUyvy:
        return take_luma(bytes, format_, 1, 2, out);
      case V4l2Format::kMjpg:
      case V4l2Format::kAny:
        break;
    }
    try {
      out = decode_gray_image(bytes, device_.name());
    } catch (const Error&) {
      return false;
    }
    return out.width == format_.width && out.height == format_.height;
  }

  [[noreturn]] void lost() const {
    const int reason = errno;
    throw LinkLost(device_.name() + (reason == ENODEV
                                         ? std::string(": was unplugged")
                                         : std::string(": gives no more images: ") + std::strerror(reason)));
  }

  std::vector<std::string> warnings_;
  V4l2Device device_;
  V4l2Image format_;
  std::unique_ptr<V4l2Buffers> buffers_;
  std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();
  int errors_ = 0;
  std::size_t damaged_ = 0;
  bool stamped_by_us_ = false;
};

}  // namespace

std::unique_ptr<CameraSource> open_v4l2(const std::string& device, const V4l2Config& config,
                                        std::unique_ptr<V4l2System> system) {
  return std::make_unique<V4l2Source>(device, config, std::move(system));
}

std::unique_ptr<CameraSource> open_v4l2(const std::string& device, const V4l2Config& config) {
  return open_v4l2(device, config, make_v4l2_system());
}

}  // namespace asperity
