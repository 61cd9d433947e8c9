#include "asperity/transport/find_usb_serial.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr int kDeepest = 8;  // folders from a port up to its USB device
constexpr std::size_t kMostNamed = 8;

struct UsbPort {
  std::string port;  // "ttyUSB0"
  std::string vendor;
  std::string product;
  std::string serial_number;
};

std::string attribute(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return std::string(trim(line));
}

std::optional<UsbPort> usb_device_of(const fs::path& tty) {
  std::error_code error;
  fs::path folder = fs::canonical(tty / "device", error);
  if (error) return std::nullopt;
  for (int i = 0; i < kDeepest && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    if (!fs::exists(folder / "idVendor", error)) continue;
    return UsbPort{tty.filename().string(), attribute(folder / "idVendor"), attribute(folder / "idProduct"),
                   attribute(folder / "serial")};
  }
  return std::nullopt;
}

std::string listed(const std::vector<UsbPort>& ports) {
  std::string out;
  for (std::size_t i = 0; i < ports.size() && i < kMostNamed; ++i) {
    out += fmt::format("{}/dev/{} (usb:{}:{}{})", i == 0 ? "" : ", ", printable(ports[i].port),
                       printable(ports[i].vendor), printable(ports[i].product),
                       ports[i].serial_number.empty() ? "" : ":" + printable(ports[i].serial_number));
  }
  return out;
}

}  // namespace

std::string find_usb_serial(const UsbSerialId& id, const fs::path& sysfs) {
  std::vector<UsbPort> all;
  std::error_code error;
  for (fs::directory_iterator it(sysfs / "class" / "tty", error), end; !error && it != end; it.increment(error)) {
    if (auto port = usb_device_of(it->path())) all.push_back(std::move(*port));
  }
  std::sort(all.begin(), all.end(), [](const UsbPort& a, const UsbPort& b) { return a.port < b.port; });
  std::vector<UsbPort> wanted;
  for (const UsbPort& port : all) {
    if (port.vendor == fmt::format("{:04x}", id.vendor) && port.product == fmt::format("{:04x}", id.product) &&
        (id.serial_number.empty() || port.serial_number == id.serial_number)) {
      wanted.push_back(port);
    }
  }
  const std::string name = fmt::format("usb:{:04x}:{:04x}{}", id.vendor, id.product,
                                       id.serial_number.empty() ? "" : ":" + printable(id.serial_number));
  if (wanted.empty()) {
    throw Error(name + ": no such serial port; is the probe plugged in? " +
                (all.empty() ? "No USB serial port was found." : "There are " + listed(all) + "."));
  }
  if (wanted.size() > 1) {
    throw Error(name + ": several ports have it: " + listed(wanted) + "; add the serial number or name the port");
  }
  return "/dev/" + wanted.front().port;
}

}  // namespace asperity
