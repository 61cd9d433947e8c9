#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace asperity {

struct UsbSerialId {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial_number;  // empty: any
};

// The device file ("/dev/ttyUSB0") of the one serial port whose USB device has this id, found in `sysfs`/class/tty
// alone: no port is opened. Throws Error if there is none, naming those that there are, or several, naming them and how
// to choose.
std::string find_usb_serial(const UsbSerialId& id, const std::filesystem::path& sysfs = "/sys");

}  // namespace asperity
