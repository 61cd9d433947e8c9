#include "asperity/transport/open_serial.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>
#include <fstream>
#include <numeric>

#include "asperity/base/host_clock.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/find_usb_serial.h"

namespace asperity {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr auto kLong = 20s;  // far longer than any of this takes

// A pseudo-terminal of this test's own, its far side in the probe's role.
class Pty {
 public:
  Pty() {
    char name[128];
    int slave = -1;
    if (::openpty(&far_, &slave, name, nullptr, nullptr) != 0) throw Error("no pseudo-terminal");
    ::close(slave);
    path_ = name;
  }
  ~Pty() { hang_up(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  const std::string& path() const { return path_; }
  void send(const Bytes& bytes) const {
    ASSERT_EQ(::write(far_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  Bytes receive(std::size_t count) const {
    Bytes out(count);
    std::size_t got = 0;
    while (got < count) {
      const ssize_t n = ::read(far_, out.data() + got, count - got);
      if (n <= 0) break;
      got += static_cast<std::size_t>(n);
    }
    out.resize(got);
    return out;
  }
  int file() const { return far_; }
  void hang_up() {
    if (far_ >= 0) ::close(far_);
    far_ = -1;
  }

 private:
  int far_ = -1;
  std::string path_;
};

Bytes read_bytes(ByteSource& source, std::size_t count) {
  Bytes out;
  Bytes buffer(100);
  while (out.size() < count) {
    const Arrival arrival = source.read(buffer, kLong);
    if (arrival.count == 0) break;
    EXPECT_LE(arrival.arrival_ns, host_now_ns());
    out.insert(out.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(arrival.count));
  }
  return out;
}

TEST(Serial, AllBytesPassBothWaysUnchanged) {
  const Pty pty;
  const auto source = open_serial(pty.path(), 921600);
  EXPECT_EQ(source->name(), "serial:" + pty.path());
  Bytes all(256);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  pty.send(all);
  EXPECT_EQ(read_bytes(*source, all.size()), all);
  EXPECT_TRUE(source->write(all));
  EXPECT_EQ(pty.receive(all.size()), all);
}

TEST(Serial, IsRawAtTheRateAskedFor) {
  const Pty pty;
  const auto source = open_serial(pty.path(), 115200);
  termios settings{};
  ASSERT_EQ(::tcgetattr(pty.file(), &settings), 0);
  EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B115200));
  EXPECT_EQ(settings.c_cflag & (CSIZE | PARENB | CSTOPB), static_cast<tcflag_t>(CS8));
  EXPECT_EQ(settings.c_lflag & (ICANON | ECHO | ISIG), 0u);
  EXPECT_EQ(settings.c_iflag & (IXON | IXOFF | ICRNL), 0u);
  EXPECT_EQ(settings.c_oflag & OPOST, 0u);
}

TEST(Serial, NothingComesInTime) {
  const Pty pty;
  const auto source = open_serial(pty.path(), 115200);
  Bytes buffer(10);
  EXPECT_EQ(source->read(buffer, 5ms).count, 0u);
  EXPECT_EQ(source->read(buffer, 0ms).count, 0u);
  // What was waited for in vain is not lost when it comes.
  pty.send({1, 2, 3});
  EXPECT_EQ(read_bytes(*source, 3), Bytes({1, 2, 3}));
}

TEST(Serial, HangingUpIsALostLink) {
  Pty pty;
  const auto source = open_serial(pty.path(), 115200);
  pty.hang_up();
  Bytes buffer(10);
  EXPECT_THAT([&] { source->read(buffer, kLong); },
              ThrowsMessage<LinkLost>(HasSubstr(pty.path() + ": the probe is gone")));
  EXPECT_THROW(source->write(buffer), LinkLost);
}

TEST(Serial, OnlyOneMayHaveIt) {
  const Pty pty;
  auto source = open_serial(pty.path(), 115200);
  termios before{};
  ASSERT_EQ(::tcgetattr(pty.file(), &before), 0);
  EXPECT_THAT([&] { open_serial(pty.path(), 9600); },
              ThrowsMessage<Error>(AllOf(HasSubstr(pty.path()), HasSubstr("is in use by process"),
                                         HasSubstr(std::to_string(::getpid())))));
  termios after{};
  ASSERT_EQ(::tcgetattr(pty.file(), &after), 0);
  EXPECT_EQ(::cfgetospeed(&after), ::cfgetospeed(&before));
  source.reset();
  open_serial(pty.path(), 115200);
}

TEST(Serial, WhatIsNoPortIsRefused) {
  const testkit::TempDir dir;
  std::ofstream(dir / "file") << "x";
  EXPECT_THAT([&] { open_serial((dir / "file").string(), 115200); },
              ThrowsMessage<Error>(HasSubstr("is not a serial port")));
  EXPECT_THAT([&] { open_serial((dir / "absent").string(), 115200); }, ThrowsMessage<Error>(HasSubstr("plugged in")));
  const Pty pty;
  EXPECT_THAT([&] { open_serial(pty.path(), 123456); }, ThrowsMessage<Error>(HasSubstr("123456 is not a baud rate")));
}

// A folder laid out as Linux lays out /sys, with three USB serial ports, one terminal that is none, and links as there.
class Sysfs {
 public:
  Sysfs() {
    add("ttyUSB0", "1-1", "10c4", "ea60", "0001");
    add("ttyUSB1", "1-2", "10c4", "ea60", "A/2");
    add("ttyACM0", "1-3", "303a", "1001", "");
    std::filesystem::create_directories(root() / "class/tty/tty0");
  }
  std::filesystem::path root() const { return dir_.path(); }

 private:
  void add(const std::string& port, const std::string& bus, const std::string& vendor, const std::string& product,
           const std::string& serial_number) const {
    const auto device = root() / "devices/pci/usb1" / bus;
    const auto tty = device / (bus + ":1.0") / port / "tty" / port;
    std::filesystem::create_directories(tty);
    std::filesystem::create_directory_symlink("../..", tty / "device");
    std::ofstream(device / "idVendor") << vendor << '\n';
    std::ofstream(device / "idProduct") << product << '\n';
    if (!serial_number.empty()) std::ofstream(device / "serial") << serial_number << '\n';
    std::filesystem::create_directories(root() / "class/tty");
    std::filesystem::create_directory_symlink(tty, root() / "class/tty" / port);
  }

  testkit::TempDir dir_;
};

TEST(UsbSerial, IsFoundByItsId) {
  const Sysfs sysfs;
  EXPECT_EQ(find_usb_serial({0x303a, 0x1001, ""}, sysfs.root()), "/dev/ttyACM0");
  EXPECT_EQ(find_usb_serial({0x10c4, 0xea60, "0001"}, sysfs.root()), "/dev/ttyUSB0");
  EXPECT_EQ(find_usb_serial({0x10c4, 0xea60, "A/2"}, sysfs.root()), "/dev/ttyUSB1");
}

TEST(UsbSerial, NoneOrSeveralAreNamed) {
  const Sysfs sysfs;
  EXPECT_THAT(
      [&] {
        find_usb_serial({0x10c4, 0xea60, ""}, sysfs.root());
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("several"), HasSubstr("/dev/ttyUSB0 (usb:10c4:ea60:0001)"),
                                 HasSubstr("/dev/ttyUSB1 (usb:10c4:ea60:A/2)"))));
  EXPECT_THAT(
      [&] {
        find_usb_serial({0x0403, 0x6001, ""}, sysfs.root());
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("usb:0403:6001: no such"), HasSubstr("/dev/ttyACM0 (usb:303a:1001)"))));
  const testkit::TempDir empty;
  EXPECT_THAT(
      [&] {
        find_usb_serial({0x0403, 0x6001, "7"}, empty.path());
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("usb:0403:6001:7"), HasSubstr("No USB serial port was found"))));
}

}  // namespace
}  // namespace asperity
