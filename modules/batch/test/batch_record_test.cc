#include "asperity/batch/batch_record.h"

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>

#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(BatchRecord, ReadsBackWhatItWrote) {
  const testkit::TempDir dir;
  const ScanRecord record{"s1/scan", "day/s1/scan", {{"process", {"process", "a \"b\""}, "0123", 3, "warned"}}};
  write(dir / "batch.json", format_scan_record(record));
  const ScanRecord back = read_scan_record(dir / "batch.json");
  EXPECT_EQ(back.name, record.name);
  EXPECT_EQ(back.recording, record.recording);
  ASSERT_EQ(back.steps.size(), 1U);
  EXPECT_EQ(back.steps[0].words, record.steps[0].words);
  EXPECT_EQ(back.steps[0].inputs, "0123");
  EXPECT_EQ(back.steps[0].exit_code, 3);
  EXPECT_EQ(back.steps[0].message, "warned");
}

TEST(BatchRecord, ADamagedOneCountsAsNothingDone) {
  const testkit::TempDir dir;
  EXPECT_TRUE(read_scan_record(dir / "absent").steps.empty());
  const std::string whole = format_scan_record({"a", "b", {{"process", {"x"}, "1", 0, ""}}});
  for (std::size_t cut = 0; cut + 1 < whole.size(); cut += 7) {
    write(dir / "cut", whole.substr(0, cut));
    EXPECT_TRUE(read_scan_record(dir / "cut").steps.empty()) << cut;
  }
  write(dir / "other", "{\"format\":\"asperity-batch-scan\",\"version\":2}");
  EXPECT_TRUE(read_scan_record(dir / "other").steps.empty());
}

TEST(BatchRecord, EveryChangeOfAnInputIsNoticed) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "rec/inner");
  write(dir / "rec/a.csv", "1\n");
  write(dir / "rec/inner/b.csv", "2\n");
  const auto now = [&] { return inputs_fingerprint(dir.path(), {"rec", "mesh.obj"}); };
  const std::string first = now();
  EXPECT_EQ(now(), first);
  write(dir / "mesh.obj", "v");
  const std::string with_mesh = now();
  EXPECT_NE(with_mesh, first);
  fs::last_write_time(dir / "rec/inner/b.csv", fs::file_time_type::clock::now() + std::chrono::hours(1));
  const std::string touched = now();
  EXPECT_NE(touched, with_mesh);
  fs::rename(dir / "rec/a.csv", dir / "rec/c.csv");
  EXPECT_NE(now(), touched);
}

TEST(BatchRecord, UpToDateOnlyWithTheSameWordsInputsAndOutput) {
  const testkit::TempDir dir;
  write(dir / "out", "x");
  const BatchStep step{"process", {"process", "rec"}, {"rec"}, "out"};
  const StepRecord record{"process", {"process", "rec"}, "f", 0, ""};
  EXPECT_TRUE(is_up_to_date(record, step, dir.path(), "f"));
  EXPECT_FALSE(is_up_to_date(record, step, dir.path(), "g"));
  StepRecord other = record;
  other.exit_code = 1;
  EXPECT_FALSE(is_up_to_date(other, step, dir.path(), "f"));
  other = record;
  other.words.push_back("--more");
  EXPECT_FALSE(is_up_to_date(other, step, dir.path(), "f"));
  fs::remove(dir / "out");
  EXPECT_FALSE(is_up_to_date(record, step, dir.path(), "f"));
}

}  // namespace
}  // namespace asperity
