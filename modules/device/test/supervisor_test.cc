#include "asperity/device/supervisor.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr std::array<std::byte, 4> kZero{std::byte{'Z'}, std::byte{'E'}, std::byte{'R'}, std::byte{'O'}};

// A pty as a serial device: what is written to `line` is read from `board`.
struct Pty {
  Pty() {
    board = ::posix_openpt(O_RDWR | O_NOCTTY);
    ::grantpt(board);
    ::unlockpt(board);
    line = ::open(::ptsname(board), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(line, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(line, TCSANOW, &raw);
  }
  ~Pty() {
    ::close(board);
    ::close(line);
  }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;
  int board = -1;
  int line = -1;
};

// What arrives until nothing has for `silence_ms`.
std::string arriving(int fd, int silence_ms) {
  std::string all;
  for (;;) {
    pollfd ready{.fd = fd, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, silence_ms) <= 0) return all;
    std::array<char, 256> part{};
    const ssize_t count = ::read(fd, part.data(), part.size());
    if (count <= 0) return all;
    all.append(part.data(), static_cast<std::size_t>(count));
  }
}

// A process that holds a force under a supervisor, ended by `signal`.
std::string last_words(int signal) {
  Pty pty;
  std::array<int, 2> ready{};
  EXPECT_EQ(::pipe(ready.data()), 0);
  const pid_t host = ::fork();
  if (host == 0) {
    const Supervisor supervisor(pty.line, kZero);
    // A frame that is cut off in the middle.
    (void)!::write(pty.line, "FORC", 4);
    (void)!::write(ready[1], "r", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  ::kill(host, signal);
  int status = 0;
  ::waitpid(host, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  ::close(ready[0]);
  ::close(ready[1]);
  return arriving(pty.board, 500);
}

TEST(Supervisor, ZeroesTheForceAfterSigkill) { EXPECT_EQ(last_words(SIGKILL), "FORCZEROZEROZERO"); }
TEST(Supervisor, ZeroesTheForceAfterACrash) { EXPECT_EQ(last_words(SIGABRT), "FORCZEROZEROZERO"); }

TEST(Supervisor, SaysNothingWhenDisarmed) {
  Pty pty;
  {
    Supervisor supervisor(pty.line, kZero);
    EXPECT_TRUE(supervisor.watching());
  }
  EXPECT_EQ(arriving(pty.board, 50), "");
}

TEST(Supervisor, OneDoesNotKeepTheOthersPipeOpen) {
  Pty first, second;
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t host = ::fork();
  if (host == 0) {
    const Supervisor a(first.line, kZero, 1);
    const Supervisor b(second.line, kZero, 1);
    (void)!::write(ready[1], "r", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  ::kill(host, SIGKILL);
  ::waitpid(host, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  EXPECT_EQ(arriving(first.board, 500), "ZERO");
  EXPECT_EQ(arriving(second.board, 500), "ZERO");
}

TEST(Supervisor, RefusesAFarewellOfNoLength) {
  EXPECT_THROW(Supervisor(0, {}), Error);
  const std::array<std::byte, Supervisor::kMaxFarewell_bytes + 1> long_one{};
  EXPECT_THROW(Supervisor(0, long_one), Error);
}

}  // namespace
}  // namespace asperity
