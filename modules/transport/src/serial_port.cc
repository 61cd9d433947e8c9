// Asio's fences are for contexts of several threads; ours have one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
#include "asperity/transport/serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

// Asio of Boost 1.74 uses std::exchange without its header.
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

#include <fmt/format.h>

#include "asperity/base/text.h"
#include "file_holders.h"

namespace asperity {

namespace asio = boost::asio;

namespace {

bool is_gone(int reason) {
  return reason == EIO || reason == ENXIO || reason == ENODEV || reason == EBADF || reason == EPIPE;
}

// A port that is open, ours alone, and not yet touched.
class HeldPort {
 public:
  explicit HeldPort(const SerialPortConfig& config) : config_(config) {
    file_ = ::open(config.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    try {
      if (file_ < 0) refuse(errno);
      if (::isatty(file_) == 0) fail("is not a serial port");
      // The lock stops those who ask for it, the superuser among them; TIOCEXCL stops everyone else.
      if (::flock(file_, LOCK_EX | LOCK_NB) != 0) refuse(errno == EWOULDBLOCK ? EBUSY : errno);
      if (::ioctl(file_, TIOCEXCL) != 0) refuse(errno);
    } catch (...) {
      close();
      throw;
    }
  }
  ~HeldPort() { close(); }
  HeldPort(const HeldPort&) = delete;
  HeldPort& operator=(const HeldPort&) = delete;

  int file() const { return file_; }
  int release() { return std::exchange(file_, -1); }

  [[noreturn]] void fail(const std::string& what) const { throw Error(config_.name + ": " + what); }

 private:
  void close() noexcept {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

  [[noreturn]] void refuse(int reason) const {
    if (reason == ENOENT) fail("the port does not exist; is " + config_.device + " plugged in?");
    if (reason == EACCES || reason == EPERM) {
      fail(
          "not permitted; add yourself to the group that owns it (Debian: sudo adduser $USER dialout) and log in "
          "again");
    }
    if (reason == EBUSY) {
      const std::string holders = file_holders(config_.path);
      fail("is in use by " + (holders.empty() ? "another program" : holders) + "; end that first");
    }
    fail(std::string("cannot be opened: ") + std::strerror(reason));
  }

  const SerialPortConfig& config_;
  int file_ = -1;
};

}  // namespace

struct SerialPort::Impl {
  explicit Impl(const SerialPortConfig& settings) : config(settings), port(context) {
    HeldPort held(config);
    termios raw{};
    if (::tcgetattr(held.file(), &raw) != 0) held.fail(std::string("cannot be set up: ") + std::strerror(errno));
    ::cfmakeraw(&raw);
    raw.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    if (::tcsetattr(held.file(), TCSANOW, &raw) != 0) {
      held.fail(std::string("cannot be set up: ") + std::strerror(errno));
    }
    port.assign(held.release());
    using Base = asio::serial_port_base;
    try {
      port.set_option(Base::character_size(8));
      port.set_option(Base::parity(Base::parity::none));
      port.set_option(Base::stop_bits(Base::stop_bits::one));
      port.set_option(Base::flow_control(Base::flow_control::none));
    } catch (const boost::system::system_error& error) {
      throw Error(config.name + ": cannot be set up: " + error.what());
    }
    try {
      port.set_option(Base::baud_rate(static_cast<unsigned>(config.baud)));
    } catch (const boost::system::system_error&) {
      throw Error(
          fmt::format("{}: {} is not a baud rate of this port; 115200 and 921600 are usual", config.name, config.baud));
    }
    ::tcflush(file(), TCIOFLUSH);
  }

  ~Impl() { ::ioctl(file(), TIOCNXCL); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int file() { return port.native_handle(); }

  [[noreturn]] void lose(int reason) const {
    if (is_gone(reason)) throw LinkLost(config.name + ": " + config.device + " is gone; is it still plugged in?");
    throw Error(config.name + ": " + std::strerror(reason));
  }

  // By ppoll, for Asio's clock rounds up to milliseconds.
  void wait(short events, Clock::time_point until) {
    constexpr std::chrono::hours kLongest{24};
    const auto left = std::clamp(until - Clock::now(), Clock::duration::zero(), Clock::duration(kLongest));
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    const timespec time{static_cast<time_t>(seconds.count()),
                        static_cast<long>(std::chrono::nanoseconds(left - seconds).count())};
    pollfd one{file(), events, 0};
    if (::ppoll(&one, 1, &time, nullptr) < 0 && errno != EINTR) lose(errno);
  }

  SerialPortConfig config;
  asio::io_context context{1};
  asio::serial_port port;
};

SerialPort::SerialPort(const SerialPortConfig& config) : impl_(std::make_unique<Impl>(config)) {}

SerialPort::~SerialPort() = default;

std::size_t SerialPort::read(std::span<std::uint8_t> into, Clock::time_point until) {
  if (into.empty()) return 0;
  for (;;) {
    const ssize_t count = ::read(impl_->file(), into.data(), into.size());
    if (count > 0) return static_cast<std::size_t>(count);
    // A terminal without the other side: end of file or EIO.
    if (count == 0) impl_->lose(EIO);
    if (errno != EAGAIN && errno != EINTR) impl_->lose(errno);
    if (Clock::now() >= until) return 0;
    impl_->wait(POLLIN, until);
  }
}

std::size_t SerialPort::write_some(std::span<const std::uint8_t> bytes) {
  std::size_t taken = 0;
  while (taken < bytes.size()) {
    const ssize_t count = ::write(impl_->file(), bytes.data() + taken, bytes.size() - taken);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (count < 0) impl_->lose(errno);
    taken += static_cast<std::size_t>(count);
  }
  return taken;
}

void SerialPort::write(std::span<const std::uint8_t> bytes, Clock::time_point until) {
  for (;;) {
    bytes = bytes.subspan(write_some(bytes));
    if (bytes.empty()) return;
    if (Clock::now() >= until) throw Error(impl_->config.name + ": takes no more: " + std::strerror(ETIMEDOUT));
    impl_->wait(POLLOUT, until);
  }
}

void SerialPort::flush_input() noexcept { ::tcflush(impl_->file(), TCIFLUSH); }

int SerialPort::descriptor() const noexcept { return impl_->file(); }

}  // namespace asperity
