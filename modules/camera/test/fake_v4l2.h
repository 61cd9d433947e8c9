#pragma once

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "v4l2_system.h"

namespace asperity {

// A camera's driver as the kernel shows it, with faults to choose. Kept by the test, played by FakeV4l2.
struct FakeCamera {
  struct Mode {
    std::uint32_t fourcc = V4L2_PIX_FMT_YUYV;
    std::uint32_t width = 640, height = 480;
    std::vector<v4l2_fract> intervals;  // of a frame, s
  };
  struct Control {
    int minimum = 0, maximum = 255, value = 0;
    bool read_only = false;
    bool forgets = false;  // takes a value and keeps its own
  };
  struct Frame {
    std::vector<unsigned char> bytes;
    timeval stamp{};
    std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    int failure = 0;  // errno of the call that would take it
  };

  std::vector<Mode> modes{{}};
  std::map<std::uint32_t, Control> controls;
  std::deque<Frame> frames;  // those to come; at their end no frame comes in time
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  int open_failure = 0, format_failure = 0, buffer_failure = 0;
  std::uint32_t forced_fourcc = 0;  // what the driver sets whatever it is asked
  std::uint32_t bytes_per_line = 0;
  std::uint32_t slowest_denominator = 0;  // a rate that the driver sets whatever it is asked
  bool unplugged = false;

  v4l2_pix_format format{};
  v4l2_fract interval{1, 30};
  std::array<std::vector<unsigned char>, 4> memory;
  std::deque<std::uint32_t> queued;
  int open_files = 0, mapped = 0;
  bool streaming = false;
};

class FakeV4l2 final : public V4l2System {
 public:
  explicit FakeV4l2(FakeCamera& camera) : camera_(camera) {
    camera.format.width = camera.modes.empty() ? 640 : camera.modes[0].width;
    camera.format.height = camera.modes.empty() ? 480 : camera.modes[0].height;
    camera.format.pixelformat = camera.modes.empty() ? V4L2_PIX_FMT_YUYV : camera.modes[0].fourcc;
  }

  int open(const char*) override {
    if (camera_.open_failure != 0) return fail(camera_.open_failure);
    ++camera_.open_files;
    return 3;
  }
  void close(int) override { --camera_.open_files; }
  void* map(int, std::size_t, std::int64_t offset) override {
    ++camera_.mapped;
    return camera_.memory[static_cast<std::size_t>(offset)].data();
  }
  void unmap(void*, std::size_t) override { --camera_.mapped; }
  int wait_readable(int, int) override { return camera_.unplugged || !camera_.frames.empty() ? 1 : 0; }

  int ioctl(int, unsigned long request, void* argument) override {
    switch (request) {
      case VIDIOC_QUERYCAP:
        return capabilities(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return format_kind(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_ENUM_FRAMESIZES:
        return size(*static_cast<v4l2_frmsizeenum*>(argument));
      case VIDIOC_ENUM_FRAMEINTERVALS:
        return interval(*static_cast<v4l2_frmivalenum*>(argument));
      case VIDIOC_G_FMT:
        return static_cast<v4l2_format*>(argument)->fmt.pix = camera_.format, 0;
      case VIDIOC_S_FMT:
        return set_format(*static_cast<v4l2_format*>(argument));
      case VIDIOC_G_PARM:
        return rate(*static_cast<v4l2_streamparm*>(argument), false);
      case VIDIOC_S_PARM:
        return rate(*static_cast<v4l2_streamparm*>(argument), true);
      case VIDIOC_QUERYCTRL:
        return query(*static_cast<v4l2_queryctrl*>(argument));
      case VIDIOC_G_CTRL:
        return control(*static_cast<v4l2_control*>(argument), false);
      case VIDIOC_S_CTRL:
        return control(*static_cast<v4l2_control*>(argument), true);
      case VIDIOC_REQBUFS:
        return buffers(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return buffer(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return camera_.queued.push_back(static_cast<v4l2_buffer*>(argument)->index), 0;
      case VIDIOC_DQBUF:
        return take(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        return camera_.streaming = true, 0;
      case VIDIOC_STREAMOFF:
        return camera_.streaming = false, 0;
      default:
        return fail(ENOTTY);
    }
  }

 private:
  static int fail(int reason) { return errno = reason, -1; }

  int capabilities(v4l2_capability& out) const { return out.capabilities = camera_.capabilities, 0; }

  // Modes of one fourcc follow each other.
  std::vector<FakeCamera::Mode> modes_of(std::uint32_t fourcc) const {
    std::vector<FakeCamera::Mode> out;
    for (const auto& mode : camera_.modes) {
      if (mode.fourcc == fourcc) out.push_back(mode);
    }
    return out;
  }
  int format_kind(v4l2_fmtdesc& out) const {
    std::vector<std::uint32_t> kinds;
    for (const auto& mode : camera_.modes) {
      if (kinds.empty() || kinds.back() != mode.fourcc) kinds.push_back(mode.fourcc);
    }
    return out.index < kinds.size() ? (out.pixelformat = kinds[out.index], 0) : fail(EINVAL);
  }
  int size(v4l2_frmsizeenum& out) const {
    const auto modes = modes_of(out.pixel_format);
    if (out.index >= modes.size()) return fail(EINVAL);
    out.type = V4L2_FRMSIZE_TYPE_DISCRETE;
    out.discrete = {modes[out.index].width, modes[out.index].height};
    return 0;
  }
  int interval(v4l2_frmivalenum& out) const {
    for (const auto& mode : modes_of(out.pixel_format)) {
      if (mode.width != out.width || mode.height != out.height || out.index >= mode.intervals.size()) continue;
      out.type = V4L2_FRMIVAL_TYPE_DISCRETE;
      out.discrete = mode.intervals[out.index];
      return 0;
    }
    return fail(EINVAL);
  }
  int set_format(v4l2_format& out) {
    if (camera_.format_failure != 0) return fail(camera_.format_failure);
    if (camera_.forced_fourcc != 0) out.fmt.pix.pixelformat = camera_.forced_fourcc;
    out.fmt.pix.bytesperline = camera_.bytes_per_line != 0
                                   ? camera_.bytes_per_line
                                   : out.fmt.pix.width * (out.fmt.pix.pixelformat == V4L2_PIX_FMT_GREY ? 1 : 2);
    camera_.format = out.fmt.pix;
    return 0;
  }
  int rate(v4l2_streamparm& out, bool set) {
    if (set) camera_.interval = out.parm.capture.timeperframe;
    if (set && camera_.slowest_denominator != 0) camera_.interval = {1, camera_.slowest_denominator};
    out.parm.capture.timeperframe = camera_.interval;
    return 0;
  }
  int query(v4l2_queryctrl& out) const {
    const auto found = camera_.controls.find(out.id);
    if (found == camera_.controls.end()) return fail(EINVAL);
    out.minimum = found->second.minimum;
    out.maximum = found->second.maximum;
    out.step = 1;
    return 0;
  }
  int control(v4l2_control& out, bool set) {
    const auto found = camera_.controls.find(out.id);
    if (found == camera_.controls.end()) return fail(EINVAL);
    if (set && found->second.read_only) return fail(EACCES);
    if (set && !found->second.forgets) found->second.value = out.value;
    return out.value = found->second.value, 0;
  }
  int buffers(v4l2_requestbuffers& out) {
    if (camera_.buffer_failure != 0) return fail(camera_.buffer_failure);
    camera_.queued.clear();
    for (auto& memory : camera_.memory) {
      memory.assign(std::size_t{4} * camera_.format.width * camera_.format.height + 4096, 0);
    }
    return out.count = std::min<std::uint32_t>(out.count, 4), 0;
  }
  int buffer(v4l2_buffer& out) const {
    if (out.index >= 4) return fail(EINVAL);
    out.length = static_cast<std::uint32_t>(camera_.memory[out.index].size());
    out.m.offset = out.index;
    return 0;
  }
  int take(v4l2_buffer& out) {
    if (camera_.unplugged) return fail(ENODEV);
    if (camera_.frames.empty() || camera_.queued.empty() || !camera_.streaming) return fail(EAGAIN);
    const FakeCamera::Frame frame = camera_.frames.front();
    camera_.frames.pop_front();
    if (frame.failure != 0) return fail(frame.failure);
    out.index = camera_.queued.front();
    camera_.queued.pop_front();
    std::copy(frame.bytes.begin(), frame.bytes.end(), camera_.memory[out.index].begin());
    out.bytesused = static_cast<std::uint32_t>(frame.bytes.size());
    out.flags = frame.flags;
    out.timestamp = frame.stamp;
    return 0;
  }

  FakeCamera& camera_;
};

}  // namespace asperity
