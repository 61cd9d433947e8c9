#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsGoneAtTheEnd) {
  const testkit::TempDir where;
  fs::path path;
  {
    const TemporaryFolder folder(where.path());
    path = folder.path();
    std::ofstream(path / "file") << "content";
    EXPECT_TRUE(fs::is_directory(path));
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_THROW(TemporaryFolder(where.path() / "none"), Error);
}

TEST(TemporaryFolder, WhatAKilledProcessLeftIsRemovedAndNothingElse) {
  const testkit::TempDir where, elsewhere;
  const TemporaryFolder held(where.path());
  // As a process that was killed leaves it: nobody has its lock.
  const fs::path stale = where / ".asperity-studio-aB3dE9";
  fs::create_directories(stale / "deep");
  std::ofstream(stale / ".asperity-temporary") << "";
  std::ofstream(stale / "deep" / "file") << "content";
  std::ofstream(elsewhere / "mine") << "mine";
  fs::create_directory_symlink(elsewhere.path(), stale / "link");
  fs::create_directory_symlink(elsewhere.path(), where / ".asperity-studio-LinkXY");
  std::ofstream(where / ".asperity-studio-FileXY") << "a file";
  fs::create_directory(where / ".asperity-studio-mine");
  fs::create_directory(where / ".asperity-studio-backup");  // a person's, by its name alone
  remove_stale_temporary_folders(where.path());
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(held.path()));
  EXPECT_TRUE(fs::exists(elsewhere / "mine"));
  EXPECT_TRUE(fs::is_symlink(where / ".asperity-studio-LinkXY"));
  for (const char* other : {".asperity-studio-FileXY", ".asperity-studio-mine", ".asperity-studio-backup"})
    EXPECT_TRUE(fs::exists(where / other)) << other;
  remove_stale_temporary_folders(where / "none");
}

}  // namespace
}  // namespace asperity::studio
