#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace asperity::cli {

// A pseudo-terminal of the test's own, and how long a byte takes through it: the kernel passes it on by a thread of
// ordinary priority, which a busy machine delays for a played 2diy too.
class LineProbe {
 public:
  LineProbe() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)) {
    char name[100];
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
        ::ptsname_r(master_, name, sizeof name) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
    slave_ = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    ::tcgetattr(slave_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_, TCSANOW, &raw);
  }
  ~LineProbe() {
    ::close(slave_);
    ::close(master_);
  }
  LineProbe(const LineProbe&) = delete;
  LineProbe& operator=(const LineProbe&) = delete;

  // To be called often: the longest that a byte was under way so far, ms.
  double longest_ms() {
    char byte = 'a';
    if (sent_) longest_ms_ = std::max(longest_ms_, since_ms());
    if (sent_ && ::read(master_, &byte, 1) == 1) sent_ = false;
    if (!sent_) {
      sent_at_ = std::chrono::steady_clock::now();
      sent_ = ::write(slave_, &byte, 1) == 1;
    }
    return longest_ms_;
  }

 private:
  double since_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - sent_at_).count();
  }

  int master_ = -1, slave_ = -1;
  bool sent_ = false;
  std::chrono::steady_clock::time_point sent_at_;
  double longest_ms_ = 0.0;
};

}  // namespace asperity::cli
