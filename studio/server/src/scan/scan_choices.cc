#include "scan/scan_choices.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/camera/open_camera.h"
#include "asperity/link/probe_address.h"
#include "asperity/studio/calls.h"
#include "asperity/tracking/open_pose_stream.h"
#include "scan/scan_config.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestText = 1000, kLongestName = 60, kMostSettings = 500;
constexpr std::array<std::string_view, 3> kSourceNames{"bench", "hardware", "replay"};

[[noreturn]] void refuse(const std::string& key, const std::string& why) {
  throw Error("scan." + printable(key, 100) + ": " + why);
}

std::string text_of(const std::string& key, const Json& value) {
  if (!value.is_string()) refuse(key, "text is needed");
  auto text = value.get<std::string>();
  if (text.size() > kLongestText) refuse(key, "too long");
  return text;
}

bool flag_of(const std::string& key, const Json& value) {
  if (!value.is_boolean()) refuse(key, "true or false is needed");
  return value.get<bool>();
}

std::map<std::string, std::string> settings_of(const Json& value) {
  if (!value.is_object() || value.size() > kMostSettings) refuse("settings", "an object of settings is needed");
  std::map<std::string, std::string> out;
  for (const auto& [path, setting] : value.items()) out[path] = text_of("settings." + path, setting);
  check_scan_config(make_scan_config(out));  // throws if it is not allowed
  return out;
}

// A folder's name that is one everywhere and hides nothing.
std::string name_of(const std::string& key, const Json& value) {
  std::string name = text_of(key, value);
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (name.empty() || name.size() > kLongestName || name.front() == '.' || !plain)
    refuse(key, "a name of letters, digits, '-', '_' and '.' is needed, at most 60 of them");
  return name;
}

void read_hardware(const Json& value, ScanChoices& out) {
  if (!value.is_object()) refuse("hardware", "an object is needed");
  for (const auto& [name, choice] : value.items()) {
    const std::string key = "hardware." + name;
    RecordInput& input = out.hardware;
    if (name == "probe") {
      input.probe = text_of(key, choice);
    } else if (name == "protocol") {
      input.protocol = text_of(key, choice);
    } else if (name == "camera") {
      input.camera = text_of(key, choice);
    } else if (name == "markers") {
      input.markers = text_of(key, choice);
    } else if (name == "poses") {
      input.poses = text_of(key, choice);
    } else if (name == "calibration") {
      input.calibration = text_of(key, choice);
    } else if (name == "uncalibrated") {
      input.uncalibrated = flag_of(key, choice);
    } else if (name == "world") {
      out.world = text_of(key, choice);
      if (out.world != "camera" && out.world != "z_up") refuse(key, "it must be camera or z_up");
    } else {
      refuse(key, "unknown key");
    }
  }
}

// `address` with its path replaced by `path`.
std::string with_path(std::string address, const std::string& old_path, const std::string& path) {
  const std::size_t at = address.find(old_path, address.find(':') + 1);
  if (old_path.empty() || at == std::string::npos) throw Error(printable(address) + ": has no path");
  return address.replace(at, old_path.size(), path);
}

// The device behind `path`, all links followed.
std::string device_of(const std::string& path) {
  std::error_code error;
  const std::filesystem::path device = std::filesystem::weakly_canonical(path, error);
  if (error || !path.starts_with('/') || !device.string().starts_with("/dev/"))
    throw Advice(printable(path, 200) + ": is not a device", "Devices are in /dev, such as serial:/dev/ttyUSB0.");
  return device.string();
}

}  // namespace

Json first_scan_section() {
  return {{"source", "bench"},
          {"hardware",
           {{"probe", ""},
            {"protocol", "open"},
            {"camera", ""},
            {"markers", ""},
            {"poses", ""},
            {"calibration", ""},
            {"uncalibrated", false},
            {"world", "camera"}}},
          {"recording", ""},
          {"segment", ""},
          {"object", ""},
          {"name", "scan"},
          {"auto", false},
          {"settings", Json::object()}};
}

ScanChoices read_scan_choices(const Json& section) {
  if (!section.is_object()) throw Error("scan: an object is needed");
  ScanChoices out;
  for (const auto& [key, value] : section.items()) {
    if (key == "source") {
      const auto found = std::find(kSourceNames.begin(), kSourceNames.end(), text_of(key, value));
      if (found == kSourceNames.end()) refuse(key, "it must be bench, hardware or replay");
      out.source = static_cast<SourceKind>(found - kSourceNames.begin());
    } else if (key == "hardware") {
      read_hardware(value, out);
    } else if (key == "recording") {
      out.recording = text_of(key, value);
    } else if (key == "segment") {
      out.segment = text_of(key, value);
    } else if (key == "object") {
      out.object = text_of(key, value);
    } else if (key == "name") {
      out.name = name_of(key, value);
    } else if (key == "auto") {
      out.automatic = flag_of(key, value);
    } else if (key == "settings") {
      out.settings = settings_of(value);
    } else {
      refuse(key, "unknown key");
    }
  }
  return out;
}

RecordInput resolve_hardware(const RecordInput& typed, const Project& project) {
  RecordInput out = typed;
  if (!typed.probe.empty()) {
    const ProbeAddress probe = parse_probe_address(typed.probe);
    if (probe.kind == ProbeLinkKind::kSerial) out.probe = with_path(typed.probe, probe.path, device_of(probe.path));
    if (probe.kind == ProbeLinkKind::kFile) {
      const std::string path = project.existing(probe.path).string();
      if (path.find('@') != std::string::npos && probe.bytes_per_s == 0.0)
        throw Advice(printable(path, 200) + ": the @ in this path could begin a rate",
                     "State the rate too, as in file:capture.bin@5000, or rename the folder.");
      out.probe = with_path(typed.probe, probe.path, path);
    }
  }
  if (!typed.camera.empty()) {
    const CameraAddress camera = parse_camera_address(typed.camera);
    if (camera.path == "-") throw Advice("the studio cannot read y4m:-", "Name a FIFO in the project's folder.");
    if (camera.kind == CameraKind::kV4l2) {
      out.camera = with_path(typed.camera, camera.path, device_of(camera.path));
    } else {
      out.camera = with_path(typed.camera, camera.path, project.existing(camera.path).string());
    }
  }
  if (!typed.poses.empty()) {
    const PoseAddress poses = parse_pose_address(typed.poses);
    if (poses.kind != PoseAddress::Kind::kUdp)
      out.poses = with_path(typed.poses, poses.path, project.existing(poses.path).string());
  }
  if (!typed.markers.empty()) out.markers = project.existing(typed.markers).string();
  if (!typed.calibration.empty()) out.calibration = project.existing(typed.calibration).string();
  return out;
}

}  // namespace asperity::studio
