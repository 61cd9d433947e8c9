#include "asperity/base/output.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

bool has_mark(const std::filesystem::path& folder) { return std::filesystem::exists(folder / "mark"); }

TEST(Output, FolderAppearsWholeOrNotAtAll) {
  testkit::TempDir dir;
  {
    OutputFolder folder(dir / "out", has_mark);
    write_file(folder.path() / "mark", "1");
  }
  EXPECT_FALSE(std::filesystem::exists(dir / "out"));
  {
    OutputFolder folder(dir / "out", has_mark);
    write_file(folder.path() / "mark", "1");
    folder.commit();
  }
  {
    OutputFolder folder(dir / "out", has_mark);
    write_file(folder.path() / "mark", "2");
    folder.commit();
  }
  EXPECT_EQ(read_file(dir / "out" / "mark", 10), "2");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

// What cannot be listed was not forced to the disk either: it must not replace what is.
TEST(Output, AFolderThatCannotBeListedReplacesNothing) {
  const testkit::TempDir dir;
  std::filesystem::create_directories(dir / "out");
  write_file(dir / "out" / "mark", "old");
  OutputFolder folder(dir / "out", has_mark);
  std::filesystem::create_directories(folder.path() / "a/b/c/d/e/f/g/h");
  write_file(folder.path() / "mark", "new");
  // No more files can be opened than a few: each level of folders that is listed takes one.
  const int next = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ASSERT_GE(next, 0);
  ::close(next);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit few{static_cast<rlim_t>(next) + 4, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  std::string said;
  try {
    folder.commit();
  } catch (const Error& error) {
    said = error.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_NE(said.find("out: cannot be written"), std::string::npos) << said;
  EXPECT_EQ(read_file(dir / "out" / "mark", 10), "old");
}

TEST(Output, AFileInPiecesAppearsWholeOrNotAtAll) {
  testkit::TempDir dir;
  write_file(dir / "log.csv", "before");
  {
    OutputFile file(dir / "log.csv");
    file.append("half");
  }
  EXPECT_EQ(read_file(dir / "log.csv", 10), "before");
  OutputFile file(dir / "log.csv");
  file.append("one ");
  file.append("two");
  EXPECT_EQ(read_file(dir / "log.csv", 10), "before");
  file.commit();
  EXPECT_EQ(read_file(dir / "log.csv", 10), "one two");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
  EXPECT_THROW(OutputFile(dir / "none" / "log.csv"), Error);
  ASSERT_EQ(::mkfifo((dir / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file(dir / "pipe", "x"), Error);
  EXPECT_TRUE(std::filesystem::is_fifo(dir / "pipe"));
}

TEST(Output, WhatCameMeanwhileIsKept) {
  testkit::TempDir dir;
  {
    OutputFolder folder(dir / "out", has_mark);
    write_file(folder.path() / "mark", "1");
    write_file(folder.path() / "old", "1");
    folder.commit();
  }
  OutputFolder folder(dir / "out", has_mark);
  write_file(folder.path() / "mark", "2");
  write_file(folder.path() / "notes", "ours");
  std::ofstream(dir / "out" / "notes") << "theirs";
  std::filesystem::create_directories(dir / "out" / "raw" / "deep");
  std::ofstream(dir / "out" / "raw" / "deep" / "photo") << "x";
  const std::vector<std::filesystem::path> expected{"notes", "raw"};
  EXPECT_EQ(folder.commit(), expected);
  EXPECT_EQ(read_file(dir / "out" / "mark", 10), "2");
  EXPECT_EQ(read_file(dir / "out" / "notes", 10), "ours");
  EXPECT_EQ(read_file(dir / "out" / "notes.kept-1", 10), "theirs");
  EXPECT_EQ(read_file(dir / "out" / "raw" / "deep" / "photo", 10), "x");
  EXPECT_FALSE(std::filesystem::exists(dir / "out" / "old"));  // ours, and replaced
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

TEST(Output, ThreadsKeepTheUmask) {
  testkit::TempDir dir;
  const mode_t before = ::umask(027);
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 30; ++k) {
        const auto path = dir / ("f" + std::to_string(t) + "_" + std::to_string(k));
        write_file(path, "x");
        struct stat status {};
        ::stat(path.c_str(), &status);
        EXPECT_EQ(status.st_mode & 0777, 0640u);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(::umask(before), 027u);
}

TEST(Output, LeavesStrangersAlone) {
  testkit::TempDir dir;
  std::filesystem::create_directory(dir / "theirs");
  std::ofstream(dir / "theirs" / "thesis.doc") << "x";
  EXPECT_THROW(OutputFolder(dir / "theirs", has_mark), Error);
  EXPECT_TRUE(std::filesystem::exists(dir / "theirs" / "thesis.doc"));
}

}  // namespace
}  // namespace asperity
