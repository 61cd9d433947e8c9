// Asio's fences are for contexts of several threads; ours have one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
#include "asperity/acquire/open_serial.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "asio_run.h"

#include <fmt/format.h>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/serial_port.hpp>

#include "asperity/base/host_clock.h"
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
  HeldPort(const std::string& path, const std::string& name) : path_(path), name_(name) {
    file_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    try {
      if (file_ < 0) refuse(errno);
      if (::isatty(file_) == 0) fail("is no serial port");
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

  [[noreturn]] void fail(const std::string& what) const { throw Error(name_ + ": " + what); }

 private:
  void close() noexcept {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

  [[noreturn]] void refuse(int reason) const {
    if (reason == ENOENT) fail("there is no such port; is the probe plugged in?");
    if (reason == EACCES || reason == EPERM) {
      fail(
          "not permitted; add yourself to the group that owns it (Debian: sudo adduser $USER dialout) and log in "
          "again");
    }
    if (reason == EBUSY) {
      const std::string holders = file_holders(path_);
      fail("is in use by " + (holders.empty() ? "another program" : holders) + "; end that first");
    }
    fail(std::string("cannot be opened: ") + std::strerror(reason));
  }

  std::string path_;
  std::string name_;
  int file_ = -1;
};

class SerialSource : public ByteSource {
 public:
  SerialSource(const std::string& path, int baud) : name_("serial:" + printable(path, 200)), port_(context_) {
    HeldPort held(path, name_);
    termios settings{};
    if (::tcgetattr(held.file(), &settings) != 0) held.fail(std::string("cannot be set up: ") + std::strerror(errno));
    ::cfmakeraw(&settings);
    settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    if (::tcsetattr(held.file(), TCSANOW, &settings) != 0) {
      held.fail(std::string("cannot be set up: ") + std::strerror(errno));
    }
    port_.assign(held.release());
    using Base = asio::serial_port_base;
    try {
      port_.set_option(Base::character_size(8));
      port_.set_option(Base::parity(Base::parity::none));
      port_.set_option(Base::stop_bits(Base::stop_bits::one));
      port_.set_option(Base::flow_control(Base::flow_control::none));
    } catch (const boost::system::system_error& error) {
      throw Error(name_ + ": cannot be set up: " + error.what());
    }
    try {
      port_.set_option(Base::baud_rate(static_cast<unsigned>(baud)));
    } catch (const boost::system::system_error&) {
      throw Error(fmt::format("{}: {} is no baud rate of this port; 115200 and 921600 are usual", name_, baud));
    }
    // Bytes from before would be taken for new ones.
    ::tcflush(port_.native_handle(), TCIFLUSH);
  }

  ~SerialSource() override { ::ioctl(port_.native_handle(), TIOCNXCL); }

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    if (into.empty()) return {};
    bool done = false;
    Arrival arrival;
    boost::system::error_code error;
    port_.async_read_some(asio::buffer(into.data(), into.size()),
                          [&](const boost::system::error_code& result, std::size_t count) {
                            arrival = {count, host_now_ns()};
                            error = result;
                            done = true;
                          });
    run_within(context_, done, timeout, [this] {
      boost::system::error_code ignored;
      port_.cancel(ignored);
    });
    if (!error || error == asio::error::operation_aborted) return arrival;
    lose(error.value(), error == asio::error::eof);
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t count = ::write(port_.native_handle(), bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return false;
      if (count < 0) lose(errno, false);
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

  std::string name() const override { return name_; }

 private:
  [[noreturn]] void lose(int reason, bool is_end) const {
    if (is_end || is_gone(reason)) throw LinkLost(name_ + ": the probe is gone; is it still plugged in?");
    throw Error(name_ + ": " + std::strerror(reason));
  }

  std::string name_;
  asio::io_context context_{1};
  asio::serial_port port_;
};

}  // namespace

std::unique_ptr<ByteSource> open_serial(const std::string& path, int baud) {
  return std::make_unique<SerialSource>(path, baud);
}

}  // namespace asperity
