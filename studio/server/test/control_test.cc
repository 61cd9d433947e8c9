// The door of a running studio for commands of the same user.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

#include "answer_control.h"
#include "asperity/base/error.h"
#include "asperity/studio/running_studios.h"
#include "asperity/testkit/temp_dir.h"
#include "control_folder.h"
#include "control_socket.h"
#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A server with its door, in a folder for this test alone.
class Control : public WebServerSocket {
 protected:
  void SetUp() override {
    if (const char* before = std::getenv("XDG_RUNTIME_DIR")) before_ = before;
    setenv("XDG_RUNTIME_DIR", runtime_.path().c_str(), 1);
    WebServerSocket::SetUp();
  }
  void TearDown() override {
    if (before_) {
      setenv("XDG_RUNTIME_DIR", before_->c_str(), 1);
    } else {
      unsetenv("XDG_RUNTIME_DIR");
    }
  }
  void open() {
    door_.emplace([this](const Json& request) { return answer_control(request, *server_, "/the/folder"); });
  }
  fs::path folder() const { return runtime_ / "asperity"; }
  fs::path socket() const {
    for (const auto& entry : fs::directory_iterator(folder())) {
      if (entry.path().extension() == kControlSuffix) return entry.path();
    }
    return {};
  }
  // A connection of our own to the door.
  int connect_to_door() const {
    const int out = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket().c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(::connect(out, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return out;
  }
  std::string answer_to(const std::string& text) const {
    const int connection = connect_to_door();
    send_all(connection, text);
    const auto line = receive_line(connection, kMostControlAnswer_bytes);
    ::close(connection);
    return line.value_or("");
  }

  testkit::TempDir runtime_;
  std::optional<std::string> before_;
  std::optional<ControlSocket> door_;
};

TEST_F(Control, ListsWhatRuns) {
  EXPECT_TRUE(running_studios().empty()) << "without a folder";
  open();
  RawClient window = browser();
  ASSERT_TRUE(answers(window));
  const auto studios = running_studios();
  ASSERT_EQ(studios.size(), 1u);
  EXPECT_EQ(studios[0].address, "http://" + host_);
  EXPECT_EQ(studios[0].port, port_);
  EXPECT_EQ(studios[0].folder, "/the/folder");
  EXPECT_EQ(studios[0].process, static_cast<int>(::getpid()));
  ASSERT_EQ(studios[0].sessions.size(), 1u);
  EXPECT_EQ(studios[0].sessions[0].windows, 1);
  EXPECT_EQ(studios[0].sessions[0].from, "127.0.0.1");
  // The list holds no secret.
  const std::string token = server_->address().substr(server_->address().find("token=") + 6);
  const std::string text = answer_to("{\"request\":\"list\"}\n");
  EXPECT_THAT(text, HasSubstr("the/folder"));
  EXPECT_THAT(text, testing::Not(HasSubstr(token)));
  EXPECT_THAT(text, testing::Not(HasSubstr(cookie_.substr(cookie_.find('=') + 1))));
}

TEST_F(Control, RenewsAndCloses) {
  open();
  RawClient window = browser();
  ASSERT_TRUE(answers(window));
  const RunningStudio studio = running_studios().at(0);
  EXPECT_THAT([&] { close_session(studio, 9); }, ThrowsMessage<Error>(HasSubstr("unknown session 9")));
  close_session(studio, 1);
  EXPECT_EQ(window.next_frame()->close_code(), 4401);
  const std::string before = server_->address();
  const std::string now = renew_token(studio);
  EXPECT_EQ(now, server_->address());
  EXPECT_NE(now, before);
}

TEST_F(Control, IsTheUsersAlone) {
  open();
  struct stat status {};
  ASSERT_EQ(::stat(folder().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0700u);
  ASSERT_EQ(::lstat(socket().c_str(), &status), 0);
  EXPECT_TRUE(S_ISSOCK(status.st_mode));
  door_.reset();
  EXPECT_EQ(socket(), fs::path()) << "it goes with the studio";
  // A folder into which others could put a socket of theirs is not used.
  for (const unsigned mode : {0750u, 0701u, 0777u}) {
    ASSERT_EQ(::chmod(folder().c_str(), mode), 0);
    EXPECT_THAT([] { running_studios(); }, ThrowsMessage<Error>(HasSubstr("not a folder of this user alone")));
    EXPECT_THAT([this] { open(); }, ThrowsMessage<Error>(HasSubstr("not a folder of this user alone")));
  }
  fs::remove(folder());
  fs::create_directory_symlink(runtime_.path(), folder());
  EXPECT_THROW(running_studios(), Error);
  EXPECT_THROW(open(), Error);
}

TEST_F(Control, RemovesWhatACrashLeft) {
  open();
  const fs::path live = socket();
  {
    // Bound, but nobody listens: as after a crash.
    const int dead = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (folder() / "dead.studio").c_str(), sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(dead);
  }
  fs::create_symlink("/dev/null", folder() / "link.studio");
  EXPECT_EQ(running_studios().size(), 1u);
  EXPECT_FALSE(fs::exists(fs::symlink_status(folder() / "dead.studio")));
  EXPECT_TRUE(fs::exists(live));
}

TEST_F(Control, RefusesWhatItDoesNotKnow) {
  open();
  for (const char* request : {"{}", "[]", "7", "{\"request\":1}", "{\"request\":\"sing\"}",
                              "{\"request\":\"close-session\"}", "{\"request\":\"close-session\",\"number\":-1}",
                              "{\"request\":\"close-session\",\"number\":\"1\"}", "{", "\xFF"}) {
    EXPECT_THAT(answer_to(std::string(request) + "\n"), HasSubstr("{\"error\":")) << request;
  }
  EXPECT_EQ(answer_to(std::string(kMostControlRequest_bytes + 5000, ' ') + "\n"), "") << "closed without an answer";
  EXPECT_EQ(running_studios().size(), 1u);
}

TEST_F(Control, WaitsForNobodyLong) {
  open();
  const int silent = connect_to_door();
  // After a silent one the next is heard within the time that one may take.
  const int next = connect_to_door();
  send_all(next, "{\"request\":\"list\"}\n");
  std::optional<std::string> line;
  for (int i = 0; i < 5 && !line; ++i) line = receive_line(next, kMostControlAnswer_bytes);
  EXPECT_THAT(line.value_or(""), HasSubstr("the/folder"));
  ::close(next);
  // Nor does its end wait.
  const int another = connect_to_door();
  const auto begin = std::chrono::steady_clock::now();
  door_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kControlPatience);
  ::close(another);
  ::close(silent);
}

TEST_F(Control, IsInTheTemporaryFolderWhereThereIsNoOther) {
  unsetenv("XDG_RUNTIME_DIR");
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", runtime_.path().c_str(), 1);
  open();
  EXPECT_EQ(running_studios().size(), 1u);
  struct stat status {};
  EXPECT_EQ(::stat((runtime_ / ("asperity-" + std::to_string(::geteuid()))).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0700u);
  if (before == nullptr) {
    unsetenv("TMPDIR");
  } else {
    setenv("TMPDIR", kept.c_str(), 1);
  }
}

TEST_F(Control, ANameMayBeLong) {
  const fs::path deep = runtime_ / std::string(100, 'd') / std::string(100, 'e');
  fs::create_directories(deep);
  setenv("XDG_RUNTIME_DIR", deep.c_str(), 1);
  open();
  EXPECT_EQ(running_studios().size(), 1u);
}

}  // namespace
}  // namespace asperity::studio
