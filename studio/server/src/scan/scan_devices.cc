#include "scan/scan_devices.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace asperity::studio {

Json devices_json() {
  std::vector<std::string> serial, cameras;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/dev", error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with("ttyUSB") || name.starts_with("ttyACM")) serial.push_back("serial:/dev/" + name);
    if (name.starts_with("video")) cameras.push_back("v4l2:/dev/" + name);
  }
  std::sort(serial.begin(), serial.end());
  std::sort(cameras.begin(), cameras.end());
  Json out;
  out["serial"] = serial;
  out["cameras"] = cameras;
  return out;
}

}  // namespace asperity::studio
