#include "pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"

namespace asperity {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw Error(std::string("pseudo-terminal: ") + what + ": " + std::strerror(errno));
}

}  // namespace

PseudoTerminal::PseudoTerminal() {
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (master_ < 0) refuse("cannot be opened");
  try {
    std::array<char, 128> name{};
    if (::grantpt(master_) != 0 || ::unlockpt(master_) != 0 || ::ptsname_r(master_, name.data(), name.size()) != 0)
      refuse("cannot be unlocked");
    port_ = name.data();
    // Opened and closed once, the far end counts as hung up until somebody opens it: that is how has_reader() knows.
    const int slave = ::open(port_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (slave < 0) refuse("its far end cannot be opened");
    termios raw{};
    const bool done = ::tcgetattr(slave, &raw) == 0 && (::cfmakeraw(&raw), ::tcsetattr(slave, TCSANOW, &raw) == 0);
    ::close(slave);
    if (!done) refuse("cannot be made raw");
  } catch (...) {
    ::close(master_);
    throw;
  }
}

PseudoTerminal::~PseudoTerminal() { ::close(master_); }

bool PseudoTerminal::has_reader() const {
  pollfd state{master_, POLLIN, 0};
  return ::poll(&state, 1, 0) >= 0 && (state.revents & POLLHUP) == 0;
}

std::size_t PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  const ssize_t taken = ::write(master_, bytes.data(), bytes.size());
  return taken > 0 ? static_cast<std::size_t>(taken) : 0;
}

void PseudoTerminal::read(std::vector<std::uint8_t>& out) {
  std::array<std::uint8_t, 256> bytes{};
  const ssize_t count = ::read(master_, bytes.data(), bytes.size());
  if (count > 0) out.insert(out.end(), bytes.begin(), bytes.begin() + count);
}

}  // namespace asperity
