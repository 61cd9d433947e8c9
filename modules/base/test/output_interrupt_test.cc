// What the thread that waits for signals sees while something is put in place. The program's renames go through here:
// behind one of them that thread comes, or it is refused.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace {

std::function<void()>* behind_next_rename = nullptr;
bool refuses_exchange = false;
int renames_until_failure = -1;  // of those without exchange; all that follow fail too; -1: none

int rename_it(const char* from, const char* to, unsigned flags) {
  if (flags == 0 && renames_until_failure == 0) {
    errno = EIO;
    return -1;
  }
  if (flags == 0 && renames_until_failure > 0) --renames_until_failure;
  const auto result = static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, flags));
  if (result == 0 && behind_next_rename != nullptr) {
    const std::function<void()> hook = std::move(*behind_next_rename);
    behind_next_rename = nullptr;
    hook();
  }
  return result;
}

}  // namespace

// In the place of libc's.
extern "C" int rename(const char* from, const char* to) noexcept { return rename_it(from, to, 0); }
extern "C" int renameat2(int /*from_folder*/, const char* from, int /*to_folder*/, const char* to,
                         unsigned flags) noexcept {
  if (refuses_exchange && (flags & RENAME_EXCHANGE) != 0) {
    errno = EINVAL;
    return -1;
  }
  return rename_it(from, to, flags);
}

namespace asperity {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

bool any(const fs::path&) { return true; }

// Only the first three outputs of a process are named, and other tests of this one have put theirs in place. True where
// the test has run in a process of its own and need not again.
bool has_run_alone() {
  constexpr const char* kAlone = "OUTPUT_INTERRUPT_ALONE";
  if (::getenv(kAlone) != nullptr) return false;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::string command = std::string(kAlone) + "=1 '" + fs::read_symlink("/proc/self/exe").string() +
                              "' --gtest_filter=" + test.test_suite_name() + "." + test.name();
  EXPECT_EQ(std::system(command.c_str()), 0);
  return true;
}

// Runs `commit` in a process of its own, as nothing is put in place any more once what is unfinished was removed.
// Behind its next rename the thread comes that a signal wakes; gives what that would say.
std::string said_behind_a_rename(const fs::path& dir, const std::function<std::function<void()>()>& prepare) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::string said;
    std::atomic<bool> done{false};
    std::thread waiting_for_signals;
    const std::function<void()> commit = prepare();
    std::function<void()> hook = [&] {
      waiting_for_signals = std::thread([&] {
        remove_unfinished_output();
        said = outputs_in_place();
        done = true;
      });
      // Time for it to come in between, if it can.
      for (int k = 0; k < 100 && !done; ++k) std::this_thread::sleep_for(3ms);
    };
    behind_next_rename = &hook;
    commit();
    waiting_for_signals.join();
    std::ofstream(dir / "said") << said << '\n';
    ::_exit(0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  return read_file(dir / "said", 10'000);
}

TEST(OutputInterrupt, AFileThatIsInPlaceIsTold) {
  if (has_run_alone()) return;
  const testkit::TempDir dir;
  const std::string said =
      said_behind_a_rename(dir.path(), [&] { return [&] { write_file(dir / "file.csv", "new"); }; });
  EXPECT_EQ(read_file(dir / "file.csv", 10), "new");
  EXPECT_THAT(said, HasSubstr((dir / "file.csv").string()));
}

TEST(OutputInterrupt, AFolderThatIsInPlaceIsToldAndWhatOthersPutIntoTheOldStays) {
  if (has_run_alone()) return;
  for (const bool exchanges : {true, false}) {
    for (const bool replaces : {true, false}) {
      const testkit::TempDir dir;
      if (replaces) {
        fs::create_directories(dir / "out");
        std::ofstream(dir / "out" / "mark") << "old";
      }
      const std::string said = said_behind_a_rename(dir.path(), [&] {
        refuses_exchange = !exchanges;
        auto folder = std::make_shared<OutputFolder>(dir / "out", any);
        write_file(folder->path() / "mark", "new");
        if (replaces) std::ofstream(dir / "out" / "of_others") << "theirs";
        return [folder] { folder->commit(); };
      });
      EXPECT_EQ(read_file(dir / "out" / "mark", 10), "new") << exchanges << replaces;
      EXPECT_THAT(said, HasSubstr((dir / "out").string())) << exchanges << replaces;
      if (replaces) {
        EXPECT_EQ(read_file(dir / "out" / "of_others", 10), "theirs") << exchanges;
      }
    }
  }
}

TEST(OutputInterrupt, NothingIsPutInPlaceBehindWhatIsTold) {
  if (has_run_alone()) return;
  const testkit::TempDir dir;
  const pid_t child = ::fork();
  if (child == 0) {
    remove_unfinished_output();
    std::thread([&] { write_file(dir / "late", "x"); }).detach();
    std::this_thread::sleep_for(200ms);
    ::_exit(outputs_in_place().empty() ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_FALSE(fs::exists(dir / "late"));
}

// A file system that cannot exchange two names: NFS, vfat, many of FUSE.
class WithoutExchange : public testing::Test {
 protected:
  WithoutExchange() {
    refuses_exchange = true;
    fs::create_directories(dir_ / "out");
    write_file(dir_ / "out" / "mark", "old");
  }
  ~WithoutExchange() override {
    refuses_exchange = false;
    renames_until_failure = -1;
  }
  // What is said where so many renames succeed; empty: nothing went wrong.
  std::string said_with(int renames) {
    OutputFolder folder(dir_ / "out", any);
    write_file(folder.path() / "mark", "new");
    renames_until_failure = renames;
    try {
      folder.commit();
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  testkit::TempDir dir_;
};

TEST_F(WithoutExchange, AFolderIsReplacedByTwoRenames) {
  EXPECT_EQ(said_with(-1), "");
  EXPECT_EQ(read_file(dir_ / "out" / "mark", 10), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_.path()), {}), 1);
}

TEST_F(WithoutExchange, TheOldStaysWhereItCannotBeMoved) {
  EXPECT_THAT(said_with(0), HasSubstr("cannot be replaced"));
  EXPECT_EQ(read_file(dir_ / "out" / "mark", 10), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_.path()), {}), 1);
}

TEST_F(WithoutExchange, AnOldThatCannotBeMovedBackIsNamed) {
  const std::string said = said_with(1);
  EXPECT_FALSE(fs::exists(dir_ / "out"));
  ASSERT_EQ(std::distance(fs::directory_iterator(dir_.path()), {}), 1);
  const fs::path left = fs::directory_iterator(dir_.path())->path();
  EXPECT_EQ(read_file(left / "mark", 10), "old");
  EXPECT_THAT(said, HasSubstr(left.string()));
}

}  // namespace
}  // namespace asperity
