#include "asperity/studio/open_browser.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "asperity/testkit/temp_dir.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;

// A variable of the environment, as it was before at the end.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

// All that is written into a pipe until its writers have gone; what came after ten seconds of silence.
std::string read_pipe(int pipe) {
  std::string out;
  char buffer[4096];
  for (;;) {
    pollfd watched{pipe, POLLIN, 0};
    if (poll(&watched, 1, 10'000) <= 0) return out;
    const ssize_t got = read(pipe, buffer, sizeof buffer);
    if (got <= 0) return out;
    out.append(buffer, static_cast<std::size_t>(got));
  }
}

TEST(OpenBrowser, GivesItNothingOfOurs) {
  const testkit::TempDir dir;
  const fs::path program = dir / "xdg-open", pipe = dir / "pipe";
  std::ofstream(program) << "#!/bin/sh\nls -l /proc/$$/fd > '" << pipe.string() << "'\n";
  fs::permissions(program, fs::perms::owner_all);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  // One that nothing keeps from children.
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_TRUE(reader >= 0 && socket >= 0);
  const Variable path("PATH", dir.path().string() + ":/usr/bin:/bin");
  const Variable display("DISPLAY", ":0"), folder("XDG_RUNTIME_DIR", dir.path().string());
  const OpenedBrowser browser("http://127.0.0.1:1/");
  const std::string files = read_pipe(reader);
  EXPECT_THAT(files, testing::HasSubstr("/dev/null"));
  EXPECT_THAT(files, testing::Not(testing::HasSubstr("socket")));
  close(socket);
  close(reader);
}

}  // namespace
}  // namespace asperity::studio
