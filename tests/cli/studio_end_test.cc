// What asperity studio says, and its exit code, where something cannot be saved at its end or used at its start.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/web/assets.h"
#include "run_asperity.h"
#include "studio_window.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class StudioEnd : public testing::Test {
 protected:
  void SetUp() override {
    if (!web::built()) GTEST_SKIP() << "built without the studio";
    fs::create_directory(project_);
  }
  // Runs a studio, does `work` in a window of it, and ends it.
  Outcome with_window(const std::function<void(StudioWindow&)>& work) const {
    const fs::path out = dir_ / "out";
    return run_and_meddle(
        {"studio", project_.string(), "--no-open"},
        [&](pid_t process) {
          try {
            StudioWindow window(out);
            work(window);
          } catch (const std::exception& fault) {
            ADD_FAILURE() << fault.what();
          }
          ::kill(process, SIGTERM);
        },
        out);
  }

  testkit::TempDir dir_;
  fs::path project_ = dir_ / "project";
  fs::path document_ = project_ / ".asperity-studio.json";
};

TEST_F(StudioEnd, EditsThatWereSavedEndWithZero) {
  const Outcome outcome = with_window([](StudioWindow& window) { window.edit("/feel/max_force_N", 1.5); });
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(fs::is_regular_file(document_));
}

// A folder in the document's place cannot be replaced.
TEST_F(StudioEnd, EditsThatCannotBeSavedAreToldAndEndWithOne) {
  const Outcome outcome = with_window([this](StudioWindow& window) {
    fs::create_directory(document_);
    window.edit("/feel/max_force_N", 1.5);
  });
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("last changes of the project could not be saved"),
                                 HasSubstr(document_.string() + ": cannot be")));
}

// A run whose log is being written: no file can be put in the place of a folder.
TEST_F(StudioEnd, ALogThatCannotBeStoredIsToldAndEndsWithOne) {
  write_text(project_ / "plate.obj", "v 0 0 0\nv 0.02 0 0\nv 0.02 0.02 0\nf 1 2 3\n");
  const Outcome outcome = with_window([this](StudioWindow& window) {
    window.edit("/feel/scene", "plate.obj");
    window.keep_lease();
    window.call("feel.start");
    window.call("feel.log", {{"on", true}});
    fs::create_directory(project_ / "feel.csv");
  });
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("the log feel.csv is lost: " + (project_ / "feel.csv").string() + ": cannot be written"),
                    Not(HasSubstr("could not be saved"))));
}

TEST_F(StudioEnd, ADamagedDocumentIsRenamedAndTold) {
  write_text(document_, "{");
  const Outcome outcome = with_window([](StudioWindow& window) { window.edit("/feel/max_force_N", 1.5); });
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("was renamed to .asperity-studio.json.unreadable: "));
  EXPECT_EQ(read_file(document_.string() + ".unreadable", 100), "{");
}

TEST_F(StudioEnd, ADocumentThatCannotBeReadIsRefusedAtTheStart) {
  fs::create_symlink(document_, document_);
  const Outcome outcome = run({"studio", project_.string(), "--no-open"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(document_.string() + ": "), HasSubstr("the studio does not start")));
}

}  // namespace
}  // namespace asperity::cli
