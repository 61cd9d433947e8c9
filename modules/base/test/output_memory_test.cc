// Memory that runs out while a folder is put in place: each allocation of commit() fails once.
#include "asperity/base/output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

// The names in a folder that are ours and unfinished, or what was replaced.
std::optional<std::string> left_behind(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().find(".tmp-") != std::string::npos) return entry.path().filename().string();
  }
  return std::nullopt;
}

// commit() in a process of its own, as libstdc++ ends it where memory runs out in a noexcept constructor of its
// directory iterators. What is said is in the file `said`; true if no allocation was left to fail.
bool commit_with_failure(const fs::path& dir, long at, int& status) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    bool done = false;
    std::string said;
    {
      OutputFolder folder(dir / "out", [](const fs::path&) { return true; });
      fs::create_directories(folder.path() / "inner");
      write_file(folder.path() / "inner" / "mark", "new");
      testkit::fail_allocation(at);
      try {
        folder.commit();
        done = testkit::allocations_until_failure() >= 0;
      } catch (const Error& error) {
        said = error.what();
      } catch (const std::bad_alloc&) {
        said = "not enough memory";
      }
      testkit::fail_allocation(-1);
    }
    write_file(dir / "said", said);
    ::_exit(done ? 1 : 0);
  }
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

TEST(OutputMemory, WhatIsLeftBehindIsNamedAtEachAllocation) {
  long told_after = 0, at = 0;
  for (;; ++at) {
    ASSERT_LT(at, 10'000);
    const testkit::TempDir dir;
    fs::create_directories(dir / "out" / "inner");
    write_file(dir / "out" / "inner" / "mark", "old");
    int status = 0;
    if (commit_with_failure(dir.path(), at, status)) break;
    const std::string now = read_file(dir / "out" / "inner" / "mark", 10);
    ASSERT_TRUE(now == "old" || now == "new") << at;
    if (!WIFEXITED(status)) {
      ASSERT_EQ(WTERMSIG(status), SIGABRT) << at;
      continue;
    }
    const std::string said = read_file(dir / "said", 10'000);
    const bool says_written = said.find("is written") != std::string::npos;
    if (now == "old") {
      EXPECT_FALSE(says_written) << at << ": " << said;
    }
    told_after += now == "new" && says_written ? 1 : 0;
    if (const auto left = left_behind(dir.path())) {
      EXPECT_NE(said.find(*left), std::string::npos) << at << ": " << *left << " is not named: " << said;
    }
  }
  EXPECT_GT(told_after, 3);  // the search of what was replaced takes memory
}

}  // namespace
}  // namespace asperity
