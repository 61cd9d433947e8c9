#include "serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

SerialPort::SerialPort(const std::string& path) : path_(printable(path, 200)) {
  file_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) fail("cannot be opened", errno);
  try {
    if (::isatty(file_) == 0) throw Error("2diy: " + path_ + ": is not a serial port");
    // TIOCEXCL does not stop the superuser.
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) fail("is in use by another program", errno);
    if (::ioctl(file_, TIOCEXCL) != 0) fail("cannot be locked", errno);
    termios settings{};
    if (::tcgetattr(file_, &settings) != 0) fail("cannot be set up", errno);
    ::cfmakeraw(&settings);
    settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    ::cfsetispeed(&settings, B115200);
    ::cfsetospeed(&settings, B115200);
    if (::tcsetattr(file_, TCSANOW, &settings) != 0) fail("cannot be set up", errno);
    ::tcflush(file_, TCIOFLUSH);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SerialPort::~SerialPort() {
  ::ioctl(file_, TIOCNXCL);
  ::close(file_);
}

void SerialPort::fail(const std::string& what, int reason) const {
  throw Error("2diy: " + path_ + ": " + what + ": " + std::strerror(reason));
}

void SerialPort::wait(short events, Clock::time_point until) {
  const auto left = std::max(until - Clock::now(), Clock::duration::zero());
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec time{static_cast<time_t>(seconds.count()),
                      static_cast<long>(std::chrono::nanoseconds(left - seconds).count())};
  pollfd one{file_, events, 0};
  if (::ppoll(&one, 1, &time, nullptr) < 0 && errno != EINTR) fail("is gone", errno);
}

void SerialPort::write(std::span<const unsigned char> bytes, Clock::time_point until) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    if (count < 0 && errno != EAGAIN && errno != EINTR) fail("is gone", errno);
    if (bytes.empty()) return;
    if (Clock::now() >= until) fail("takes no more", ETIMEDOUT);
    wait(POLLOUT, until);
  }
}

std::size_t SerialPort::read(std::span<unsigned char> bytes, Clock::time_point until) {
  while (true) {
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    if (count > 0) return static_cast<std::size_t>(count);
    // A terminal without the other side: end of file or EIO.
    if (count == 0) fail("is gone", EIO);
    if (errno != EAGAIN && errno != EINTR) fail("is gone", errno);
    if (Clock::now() >= until) return 0;
    wait(POLLIN, until);
  }
}

void SerialPort::flush_input() noexcept { ::tcflush(file_, TCIFLUSH); }

}  // namespace asperity
