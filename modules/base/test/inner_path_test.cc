#include "asperity/base/inner_path.h"

#include <gtest/gtest.h>

#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

TEST(InnerFile, IsInsideTheFolder) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "in");
  fs::create_symlink(dir / "in", dir / "in/here");
  fs::create_symlink(dir.path(), dir / "in/out");
  EXPECT_EQ(inner_file(dir / "in", "a/b.csv"), fs::canonical(dir / "in") / "a/b.csv");  // there or not
  EXPECT_EQ(inner_file(dir / "in", "here/b.csv"), fs::canonical(dir / "in") / "b.csv");
  EXPECT_EQ(inner_file(dir / "in", "out/b.csv"), std::nullopt);
  EXPECT_EQ(inner_file(dir / "in", "../b.csv"), std::nullopt);
}

TEST(InnerFile, LeadsSomewhere) {
  const testkit::TempDir dir;
  fs::create_symlink(dir / "loop", dir / "loop");
  EXPECT_EQ(inner_file(dir.path(), "loop"), std::nullopt);
  EXPECT_EQ(inner_file(dir.path(), std::string(5000, 'a')), std::nullopt);
}

}  // namespace
}  // namespace asperity
