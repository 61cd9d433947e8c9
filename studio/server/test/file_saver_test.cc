#include "file_saver.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "asperity/testkit/temp_dir.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Faults {
  void add(std::string fault) {
    const std::lock_guard lock(mutex);
    all.push_back(std::move(fault));
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return all.size();
  }
  std::mutex mutex;
  std::vector<std::string> all;
};

TEST(FileSaver, WritesTheNewest) {
  const testkit::TempDir dir;
  Faults faults;
  FileSaver saver(dir / "state", [&](std::string fault) { faults.add(std::move(fault)); });
  for (int i = 0; i < 50; ++i) saver.save("state " + std::to_string(i));
  EXPECT_EQ(saver.finish(), "");
  EXPECT_EQ(content(dir / "state"), "state 49");
  EXPECT_EQ(faults.count(), 0u);
}

// The folder is missing for a while, as a disk may be full: nothing else has to be saved for the next try.
TEST(FileSaver, TriesAgainByItself) {
  const testkit::TempDir dir;
  const fs::path file = dir / "folder" / "state";
  Faults faults;
  FileSaver saver(file, [&](std::string fault) { faults.add(std::move(fault)); });
  saver.save("kept");
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (faults.count() == 0 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  ASSERT_GT(faults.count(), 0u);
  fs::create_directory(dir / "folder");
  while (!fs::exists(file) && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(content(file), "kept");
  EXPECT_EQ(saver.finish(), "");
}

TEST(FileSaver, TriesOnceMoreAtTheEndAndSaysWhatIsLost) {
  const testkit::TempDir dir;
  const fs::path file = dir / "folder" / "state";
  for (const bool mended : {true, false}) {
    Faults faults;
    FileSaver saver(file, [&](std::string fault) { faults.add(std::move(fault)); });
    saver.save("last");
    while (faults.count() == 0) std::this_thread::yield();
    if (mended) fs::create_directory(dir / "folder");
    const std::string lost = saver.finish();
    EXPECT_EQ(lost.empty(), mended) << lost;
    EXPECT_EQ(fs::exists(file), mended);
    if (!mended) {
      EXPECT_THAT(lost, testing::HasSubstr("state"));
    }
    fs::remove_all(dir / "folder");
  }
}

// The studio is closed right after an edit, and the only try so far has failed.
TEST(FileSaver, WhatFailsAtTheEndHasOneMoreTry) {
  const testkit::TempDir dir;
  const fs::path file = dir / "folder" / "state";
  FileSaver saver(file, [&](const std::string&) { fs::create_directory(dir / "folder"); });
  saver.save("last");
  EXPECT_EQ(saver.finish(), "");
  EXPECT_EQ(content(file), "last");
}

}  // namespace
}  // namespace asperity::studio
