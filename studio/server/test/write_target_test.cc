#include "write_target.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_hub.h"

namespace asperity::studio {
namespace {

TEST(WriteTarget, AFileThatCameMeanwhileIsKeptAndEveryWindowIsTold) {
  const testkit::TempDir dir;
  const std::filesystem::path target = dir / "result";
  OutputFolder folder(target, [](const std::filesystem::path&) { return false; });
  std::ofstream(folder.path() / "ours.txt") << "ours";
  std::filesystem::create_directory(target);
  std::ofstream(target / "theirs.txt") << "theirs";
  FakeHub hub;
  put_in_place(folder, "result", hub);
  EXPECT_TRUE(std::filesystem::exists(target / "ours.txt"));
  EXPECT_TRUE(std::filesystem::exists(target / "theirs.txt"));
  const std::vector<Json> notes = hub.events("note");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].at("message"), "result/theirs.txt was added there in the meantime; it was kept");
}

}  // namespace
}  // namespace asperity::studio
