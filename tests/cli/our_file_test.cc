#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "feel_fixture.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

// A socket's name stays when it is closed.
void make_socket(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(path.size(), sizeof(address.sun_path));
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ::close(socket);
}

class OurFiles : public FeelCommands {
 protected:
  OurFiles() {
    std::string heights = "s_m,height_m\n";
    for (int i = 0; i < 2000; ++i) {
      heights += text_of(25e-6 * i) + "," + text_of(20e-6 * std::sin(2.0 * M_PI * 0.025 * i / 2.5)) + "\n";
    }
    write_text(path("profile.csv"), heights);
    write_stroke("path.csv", 0.5e-3, 0, 1'000'000);
  }

  // The command that writes `file`, by its kind.
  Words writing(const std::string& kind, const std::string& file) const {
    if (kind == "log") return {"feel", path("scene"), "--replay", path("path.csv"), "--log", path(file)};
    if (kind == "fit") return {"texture", "fit", path("profile.csv"), "-o", path(file)};
    return {"texture", "synthesize", path("wave.texture.json"), "-o", path(file)};
  }
};

TEST_F(OurFiles, OnlyTheirOwnKindIsReplaced) {
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"log", "x.csv"}, {"fit", "x.json"}, {"line", "x.csv"}, {"tile", "x.png"}};
  for (const auto& one : kinds) {
    const std::string &kind = one.first, &name = one.second;  // clang 14 captures no structured binding
    SCOPED_TRACE(kind);
    ASSERT_EQ(run(writing(kind, name)).code, 0);
    ASSERT_EQ(run(writing(kind, name)).code, 0) << "its own is replaced";
    const fs::path file = path(name);
    fs::rename(file, path("moved"));
    const auto refused = [&](const char* what) {
      const fs::file_type before = fs::symlink_status(file).type();
      const Outcome outcome = run(writing(kind, name));
      EXPECT_EQ(outcome.code, 1) << what;
      EXPECT_THAT(outcome.err, HasSubstr("nothing was changed")) << what;
      EXPECT_EQ(fs::symlink_status(file).type(), before) << what;
      fs::remove(file);
    };
    fs::create_symlink(path("moved"), file);
    refused("a link");
    fs::create_directory(file);
    refused("a folder");
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    refused("a pipe");
    make_socket(file.string());
    refused("a socket");
    write_text(file, "my,data\n");
    refused("another's file");
    write_text(file, "");
    EXPECT_EQ(run(writing(kind, name)).code, 0) << "an empty file is nobody's";
    fs::remove(file);
  }
}

TEST_F(OurFiles, NoInputIsReplaced) {
  const std::string texture = path("wave.texture.json");
  const auto before = contents(dir_.path());
  const Outcome outcome = run({"texture", "fit", texture, "--model", "heightmap", "-o", texture});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is read by this command"));
  EXPECT_EQ(contents(dir_.path()), before);
}

TEST_F(OurFiles, FilesBesideATextureAreNotLost) {
  write_text(path("y.heights.png"), "mine");
  const Words words{"texture", "fit", path("wave.texture.json"), "--model", "heightmap", "-o", path("y.texture.json")};
  EXPECT_EQ(run(words).code, 1);
  EXPECT_FALSE(fs::exists(path("y.texture.json")));
  fs::remove(path("y.heights.png"));
  EXPECT_EQ(run(words).code, 0);
  EXPECT_EQ(run(words).code, 0) << "its own image is replaced";
}

TEST_F(OurFiles, ABenchTakesASceneOfAFolder) {
  const Outcome outcome = run({"bench", "render", path("scene")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace asperity::cli
