#include "v4l2_formats.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::uint32_t kMostEntries = 1000;
constexpr double kRateTolerance = 0.02;  // cameras say 120 and mean 119.9

constexpr std::array<std::pair<V4l2Format, std::uint32_t>, 4> kFormats{{{V4l2Format::kGrey, V4L2_PIX_FMT_GREY},
                                                                        {V4l2Format::kYuyv, V4L2_PIX_FMT_YUYV},
                                                                        {V4l2Format::kUyvy, V4L2_PIX_FMT_UYVY},
                                                                        {V4l2Format::kMjpg, V4L2_PIX_FMT_MJPEG}}};

std::string fourcc_text(std::uint32_t fourcc) {
  std::string out;
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((fourcc >> shift) & 0x7f);
  return std::string(trim(printable(out)));
}

double fastest_rate_Hz(const V4l2Device& device, std::uint32_t fourcc, int width, int height) {
  double fastest = 0.0;
  for (std::uint32_t index = 0; index < kMostEntries; ++index) {
    v4l2_frmivalenum entry{};
    entry.index = index;
    entry.pixel_format = fourcc;
    entry.width = static_cast<std::uint32_t>(width);
    entry.height = static_cast<std::uint32_t>(height);
    if (!device.ask(VIDIOC_ENUM_FRAMEINTERVALS, entry)) break;
    const bool discrete = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    const v4l2_fract interval = discrete ? entry.discrete : entry.stepwise.min;
    if (interval.numerator > 0) {
      fastest = std::max(fastest, static_cast<double>(interval.denominator) / interval.numerator);
    }
    if (!discrete) break;
  }
  return fastest;
}

void add_mode(const V4l2Device& device, std::uint32_t fourcc, std::uint32_t width, std::uint32_t height,
              std::vector<V4l2Mode>& out) {
  if (width < 1 || height < 1 || std::max(width, height) > kLargestImageSide_px || out.size() >= kMostEntries) return;
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  out.push_back({fourcc, w, h, fastest_rate_Hz(device, fourcc, w, h)});
}

std::string describe_modes(const std::vector<V4l2Mode>& modes) {
  if (modes.empty()) return "the camera does not list its modes";
  std::string out = "it has";
  constexpr std::size_t kShown = 40;
  for (std::size_t i = 0; i < std::min(modes.size(), kShown); ++i) {
    const V4l2Mode& mode = modes[i];
    out += fmt::format("{} {} {}x{}", i == 0 ? "" : ",", fourcc_text(mode.fourcc), mode.width, mode.height);
    if (mode.fastest_Hz > 0.0) out += fmt::format(" at {:.4g} Hz", mode.fastest_Hz);
  }
  return modes.size() > kShown ? out + ", …" : out;
}

v4l2_format current_format(const V4l2Device& device) {
  v4l2_format out{};
  out.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (!device.ask(VIDIOC_G_FMT, out))
    throw Error(device.name() + ": does not report its format: " + std::strerror(errno));
  return out;
}

// The first format in our order that the camera has as asked for.
std::uint32_t choose_format(const std::vector<V4l2Mode>& modes, const V4l2Config& config, const v4l2_format& wanted,
                            const V4l2Device& device) {
  for (const auto& [format, fourcc] : kFormats) {
    if (config.format != V4l2Format::kAny && config.format != format) continue;
    for (const V4l2Mode& mode : modes) {
      const bool size = mode.width == static_cast<int>(wanted.fmt.pix.width) &&
                        mode.height == static_cast<int>(wanted.fmt.pix.height);
      const bool rate =
          config.rate_Hz == 0.0 || mode.fastest_Hz == 0.0 || mode.fastest_Hz >= (1.0 - kRateTolerance) * config.rate_Hz;
      if (mode.fourcc == fourcc && size && rate) return fourcc;
    }
  }
  // A driver that tells nothing, or a range of sizes: it decides when it is set.
  for (const auto& [format, fourcc] : kFormats) {
    if (config.format == format) return fourcc;
    if (config.format == V4l2Format::kAny && modes.empty() && wanted.fmt.pix.pixelformat == fourcc) return fourcc;
  }
  throw Error(fmt::format("{}: no images of {}x{}{} that could be used (grey, yuyv, uyvy, mjpg); {}", device.name(),
                          wanted.fmt.pix.width, wanted.fmt.pix.height,
                          config.rate_Hz > 0.0 ? fmt::format(" at {:.4g} Hz", config.rate_Hz) : "",
                          describe_modes(modes)));
}

double set_rate(const V4l2Device& device, double rate_Hz, std::vector<std::string>& warnings) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (!device.ask(VIDIOC_G_PARM, parameters)) {
    if (rate_Hz > 0.0) warnings.push_back("the rate cannot be set: the driver has no such call");
    return 0.0;
  }
  v4l2_fract& interval = parameters.parm.capture.timeperframe;
  if (rate_Hz > 0.0) {
    interval = {1'000'000, static_cast<std::uint32_t>(std::lround(rate_Hz * 1e6))};
    if (rate_Hz > 4000.0) interval = {1000, static_cast<std::uint32_t>(std::lround(rate_Hz * 1e3))};
    if (!device.ask(VIDIOC_S_PARM, parameters)) {
      warnings.push_back(std::string("the rate cannot be set: ") + std::strerror(errno));
    }
  }
  const double taken_Hz = interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator : 0.0;
  if (rate_Hz > 0.0 && std::abs(taken_Hz - rate_Hz) > kRateTolerance * rate_Hz) {
    warnings.push_back(fmt::format("the rate is {:.4g} Hz, not {:.4g} Hz", taken_Hz, rate_Hz));
  }
  return taken_Hz;
}

}  // namespace

std::vector<V4l2Mode> list_modes(const V4l2Device& device) {
  std::vector<V4l2Mode> out;
  for (std::uint32_t index = 0; index < kMostEntries; ++index) {
    v4l2_fmtdesc kind{};
    kind.index = index;
    kind.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device.ask(VIDIOC_ENUM_FMT, kind)) break;
    for (std::uint32_t size = 0; size < kMostEntries; ++size) {
      v4l2_frmsizeenum entry{};
      entry.index = size;
      entry.pixel_format = kind.pixelformat;
      if (!device.ask(VIDIOC_ENUM_FRAMESIZES, entry)) break;
      if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
        add_mode(device, kind.pixelformat, entry.discrete.width, entry.discrete.height, out);
        continue;
      }
      add_mode(device, kind.pixelformat, entry.stepwise.min_width, entry.stepwise.min_height, out);
      add_mode(device, kind.pixelformat, entry.stepwise.max_width, entry.stepwise.max_height, out);
      break;
    }
  }
  return out;
}

V4l2Image agree_on_format(const V4l2Device& device, const V4l2Config& config, std::vector<std::string>& warnings) {
  const std::vector<V4l2Mode> modes = list_modes(device);
  v4l2_format format = current_format(device);
  if (config.width > 0) {
    format.fmt.pix.width = static_cast<std::uint32_t>(config.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(config.height);
  }
  format.fmt.pix.pixelformat = choose_format(modes, config, format, device);
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = 0;
  format.fmt.pix.sizeimage = 0;
  const v4l2_pix_format asked = format.fmt.pix;
  if (!device.ask(VIDIOC_S_FMT, format)) {
    if (errno == EBUSY) throw Error(device.name() + ": is used by another program");
    throw Error(device.name() + ": the format cannot be set: " + std::strerror(errno) + "; " + describe_modes(modes));
  }
  const v4l2_pix_format& got = format.fmt.pix;
  if (got.pixelformat != asked.pixelformat || got.width != asked.width || got.height != asked.height) {
    throw Error(fmt::format("{}: gives {} {}x{} where {} {}x{} was asked for; {}", device.name(),
                            fourcc_text(got.pixelformat), got.width, got.height, fourcc_text(asked.pixelformat),
                            asked.width, asked.height, describe_modes(modes)));
  }
  if (got.field != V4L2_FIELD_NONE && got.field != V4L2_FIELD_ANY) {
    throw Error(device.name() + ": its images are interlaced: their halves are of different times");
  }
  V4l2Image out;
  for (const auto& [kind, fourcc] : kFormats) {
    if (got.pixelformat == fourcc) out.format = kind;
  }
  out.width = static_cast<int>(got.width);
  out.height = static_cast<int>(got.height);
  if (std::min(out.width, out.height) < 1 || std::max(out.width, out.height) > kLargestImageSide_px) {
    throw Error(fmt::format("{}: images of {}x{} are not within 1 to {} pixels a side", device.name(), got.width,
                            got.height, kLargestImageSide_px));
  }
  const std::size_t least = static_cast<std::size_t>(out.width) * (out.format == V4l2Format::kGrey ? 1 : 2);
  out.bytes_per_line = std::max<std::size_t>(got.bytesperline, least);
  out.rate_Hz = set_rate(device, config.rate_Hz, warnings);
  return out;
}

}  // namespace asperity
