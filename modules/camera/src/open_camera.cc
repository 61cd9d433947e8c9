#include "asperity/camera/open_camera.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/camera/open_v4l2.h"
#include "asperity/camera/open_video.h"
#include "asperity/camera/open_y4m.h"

namespace asperity {

namespace {

constexpr std::string_view kForms =
    "v4l2:/dev/videoN?size=640x480&rate=120&exposure=2ms, y4m:PATH, images:FOLDER?rate=45 or video:FILE";
constexpr double kLargestRate_Hz = 1e5;
constexpr double kLongestExposure_s = 10.0;

// An option of an address: where it stands, for messages, and its value.
struct Option {
  std::string where;
  std::string_view value;

  double rate_Hz() const {
    const auto rate = parse_double(value);
    if (!rate || !(*rate > 0.0 && *rate <= kLargestRate_Hz)) fail("is not a rate in Hz, such as rate=120");
    return *rate;
  }
  int integer() const {
    const auto number = parse_int64(value);
    if (!number || *number < 0 || *number > 1'000'000) fail("is not a whole number from 0 to 1000000");
    return static_cast<int>(*number);
  }
  void size(V4l2Config& out) const {
    const auto x = value.find('x');
    const auto width = parse_int64(value.substr(0, x));
    const auto height = x == std::string_view::npos ? std::nullopt : parse_int64(value.substr(x + 1));
    if (!width || !height || std::min(*width, *height) < 1 || std::max(*width, *height) > kLargestImageSide_px) {
      fail("is not a size in pixels, such as size=640x480");
    }
    out.width = static_cast<int>(*width);
    out.height = static_cast<int>(*height);
  }
  double exposure_s() const {
    const double exposure_s = parse_duration_s(value, where);
    if (!(exposure_s > 0.0 && exposure_s <= kLongestExposure_s)) fail("is not within 0 and 10s");
    return exposure_s;
  }
  V4l2Format format() const {
    for (std::size_t i = 0; i < kV4l2FormatNames.size(); ++i) {
      if (value == kV4l2FormatNames[i]) return static_cast<V4l2Format>(i);
    }
    fail("is none of any, grey, yuyv, uyvy, mjpg");
  }
  [[noreturn]] void fail(const std::string& why) const { throw Error(where + ": '" + printable(value) + "' " + why); }
};

void set_v4l2(V4l2Config& out, std::string_view key, const Option& option) {
  if (key == "size") {
    option.size(out);
  } else if (key == "rate") {
    out.rate_Hz = option.rate_Hz();
  } else if (key == "format") {
    out.format = option.format();
  } else if (key == "exposure") {
    out.exposure_s = option.exposure_s();
  } else if (key == "gain") {
    out.gain = option.integer();
  } else if (key == "white_balance") {
    out.white_balance_K = option.integer();
  } else if (key == "focus") {
    out.focus = option.integer();
  } else {
    throw Error(option.where + ": unknown; there are size, rate, format, exposure, gain, white_balance and focus");
  }
}

void set_option(CameraAddress& out, std::string_view key, const Option& option) {
  if (out.kind == CameraKind::kV4l2) return set_v4l2(out.v4l2, key, option);
  if (out.kind == CameraKind::kImages && key == "rate") {
    out.images.rate_Hz = option.rate_Hz();
    return;
  }
  throw Error(option.where + ": unknown; " + (out.kind == CameraKind::kImages ? "there is rate" : "there are none"));
}

}  // namespace

CameraAddress parse_camera_address(std::string_view text) {
  const std::string shown = "camera '" + printable(text, 200) + "'";
  const auto colon = text.find(':');
  const auto kind = std::find(kCameraKindNames.begin(), kCameraKindNames.end(), text.substr(0, colon));
  if (colon == std::string_view::npos || kind == kCameraKindNames.end()) {
    throw Error(shown + ": is none of " + std::string(kForms));
  }
  CameraAddress out;
  out.kind = static_cast<CameraKind>(kind - kCameraKindNames.begin());
  const std::string_view rest = text.substr(colon + 1);
  const auto question = rest.rfind('?');
  out.path = rest.substr(0, question);
  if (out.path.empty()) throw Error(shown + ": names no " + (out.kind == CameraKind::kV4l2 ? "device" : "file"));
  if (out.path.find('\0') != std::string::npos) throw Error(shown + ": the path has a NUL byte");
  if (question == std::string_view::npos) return out;

  std::set<std::string, std::less<>> seen;
  std::string_view options = rest.substr(question + 1);
  for (;;) {
    const auto end = options.find('&');
    const std::string_view option = options.substr(0, end);
    const auto equals = option.find('=');
    const std::string_view key = option.substr(0, equals);
    const std::string where = shown + ": option '" + printable(key) + "'";
    if (equals == std::string_view::npos) throw Error(where + ": has no value (KEY=VALUE)");
    if (!seen.emplace(key).second) throw Error(where + ": is given twice");
    set_option(out, key, {where, option.substr(equals + 1)});
    if (end == std::string_view::npos) return out;
    options.remove_prefix(end + 1);
  }
}

std::unique_ptr<CameraSource> open_camera(const CameraAddress& address) {
  switch (address.kind) {
    case CameraKind::kY4m:
      return open_y4m(address.path);
    case CameraKind::kImages:
      return open_image_folder(address.path, address.images);
    case CameraKind::kV4l2:
      return open_v4l2(address.path, address.v4l2);
    case CameraKind::kVideo:
      return open_video(address.path);
  }
  throw Error("camera: this kind of camera is unknown");
}

}  // namespace asperity
