#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "asperity/web/assets.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* seed : {"1", "2"}) {
      const std::string recording = (dir / (std::string("rec") + seed)).string();
      ASSERT_EQ(
          run({"simulate", "--surface", "sine", "--seed", seed, "--set", "hand.length_m=0.03", "-o", recording}).code,
          0);
    }
  }
  Outcome process(const std::string& out) {
    return run({"process", (dir / "rec1").string(), (dir / "rec2").string(), "-o", (dir / out).string(), "--quiet"});
  }
  static std::string text(const fs::path& file) {
    for (const auto& [name, content] : contents(file.parent_path())) {
      if (name == file.filename()) return content;
    }
    return "";
  }

  testkit::TempDir dir;
};

TEST_F(Report, IsWrittenBesideEachResultAndForAllTogether) {
  ASSERT_EQ(process("out").code, 0);
  for (const char* place : {"out", "out/rec1", "out/rec2"}) {
    EXPECT_EQ(fs::exists(dir / place / "report.html"), web::built()) << place;
  }
  const auto first = contents(dir / "out");
  // The folder is known for the program's own, and the same input gives the same bytes.
  ASSERT_EQ(process("out").code, 0);
  EXPECT_TRUE(contents(dir / "out") == first);
  // A folder of before there were reports, and one with a stranger's file.
  for (const char* place : {"out", "out/rec1", "out/rec2"}) fs::remove(dir / place / "report.html");
  EXPECT_EQ(process("out").code, 0);
  write_text(dir / "out" / "rec1" / "mine.txt", "");
  const Outcome refused = process("out");
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("out: the file rec1/mine.txt was not written by asperity; nothing was changed. "
                                     "Move this file elsewhere, or choose another output folder"));
  EXPECT_TRUE(fs::exists(dir / "out" / "rec1" / "mine.txt"));
}

TEST_F(Report, IsMadeAnewFromTheFiles) {
  ASSERT_EQ(process("out").code, 0);
  if (!web::built()) {
    const Outcome outcome = run({"report", (dir / "out").string()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("built without reports"));
    return;
  }
  const std::string file = (dir / "two.html").string();
  const Outcome outcome =
      run({"report", (dir / "out/rec2").string(), (dir / "out/rec1").string(), "-o", file, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["format"], "asperity-report");
  EXPECT_EQ(json["results"].size(), 2u);
  EXPECT_THAT(text(file).substr(0, 2000), HasSubstr("<!doctype html>"));
  fs::remove(dir / "out/rec1/report.html");
  ASSERT_EQ(run({"report", (dir / "out/rec1").string()}).code, 0);
  EXPECT_TRUE(fs::exists(dir / "out/rec1/report.html"));
  // The folder is still one that `process` may write anew.
  EXPECT_EQ(run({"process", (dir / "rec1").string(), "-o", (dir / "out/rec1").string(), "--quiet"}).code, 0);
}

TEST_F(Report, LeavesFilesOfOthersAlone) {
  ASSERT_EQ(process("out").code, 0);
  const auto report = [&](const fs::path& file) {
    return run({"report", (dir / "out/rec1").string(), "-o", file.string()});
  };
  const std::string page = "<!doctype html>\n<title>My page</title>\n";
  write_text(dir / "notes.html", page);
  fs::create_symlink(dir / "notes.html", dir / "link.html");
  for (const char* name : {"notes.html", "link.html", "out/rec1/result.json", "out"}) {
    const Outcome outcome = report(dir / name);
    EXPECT_EQ(outcome.code, 1) << name;
    EXPECT_THAT(outcome.err, HasSubstr("nothing was changed")) << name;
  }
  EXPECT_EQ(text(dir / "notes.html"), page);
  // The one that would be written without -o, too.
  write_text(dir / "out/rec1/report.html", page);
  EXPECT_EQ(run({"report", (dir / "out/rec1").string()}).code, 1);
  EXPECT_EQ(text(dir / "out/rec1/report.html"), page);
  if (!web::built()) return;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(report(dir / "new.html").code, 0) << "its own is written anew";
}

TEST_F(Report, SaysWhatIsWrong) {
  ASSERT_EQ(process("out").code, 0);
  const Outcome no_file = run({"report", (dir / "out/rec1").string(), (dir / "out/rec2").string()});
  EXPECT_EQ(no_file.code, 2);
  EXPECT_THAT(no_file.err, HasSubstr("-o FILE.html"));
  const Outcome no_folder = run({"report", (dir / "none").string()});
  EXPECT_EQ(no_folder.code, 1);
  EXPECT_THAT(no_folder.err, HasSubstr("none: no such folder"));
  const Outcome recording = run({"report", (dir / "rec1").string()});
  EXPECT_EQ(recording.code, 1);
  EXPECT_THAT(recording.err, HasSubstr("no result.json"));
  write_text(dir / "out/rec1/result.json", "{");
  const Outcome damaged = run({"report", (dir / "out/rec1").string()});
  EXPECT_EQ(damaged.code, 1);
  EXPECT_THAT(damaged.err, HasSubstr("result.json:1:1: not JSON"));
}

}  // namespace
}  // namespace asperity::cli
