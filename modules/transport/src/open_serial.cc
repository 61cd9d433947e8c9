#include "asperity/transport/open_serial.h"

#include <algorithm>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/transport/serial_port.h"

namespace asperity {

namespace {

class SerialSource : public ByteSource {
 public:
  SerialSource(const std::string& path, int baud)
      : name_("serial:" + printable(path, 200)), port_({path, baud, name_, "the probe"}) {}

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    constexpr std::chrono::hours kLongest{24};
    const std::size_t count =
        port_.read(into, SerialPort::Clock::now() + std::min<std::chrono::milliseconds>(timeout, kLongest));
    return {count, host_now_ns()};
  }

  bool write(std::span<const std::uint8_t> bytes) override { return port_.write_some(bytes) == bytes.size(); }

  std::string name() const override { return name_; }

 private:
  std::string name_;
  SerialPort port_;
};

}  // namespace

std::unique_ptr<ByteSource> open_serial(const std::string& path, int baud) {
  return std::make_unique<SerialSource>(path, baud);
}

}  // namespace asperity
