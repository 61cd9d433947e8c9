#include <gmock/gmock.h>
#include <sys/resource.h>
#include <csignal>

#include <filesystem>
#include <string>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

// A limit on the size of files, as of `ulimit -f`, is an error like a full disk: SIGXFSZ would kill.
TEST(DiskLimit, IsAnErrorAndLeavesNothing) {
  const testkit::TempDir dir;
  const rlimit small{100'000, RLIM_INFINITY};
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Outcome outcome = run({"simulate", "--surface", "sine", "--seed", "1", "-o", (dir / "rec").string()});
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr("File too large"));
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace
}  // namespace asperity::cli
