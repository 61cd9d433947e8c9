#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "asperity/base/crc32.h"
#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/recording_appender.h"
#include "asperity/recording/recover_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "random_recording.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kRows = 8000;  // some 190 KiB: three blocks

ProbeSample probe_sample(int i) {
  ProbeSample out;
  out.t_ns = 250'000 * std::int64_t{i};
  out.accel_counts = {1.0 * i, -2.0 * i, 2048.5};
  out.force_counts = 10.0 + i % 7;
  return out;
}

Calibration any_calibration() {
  Random random(1);
  return random_calibration(random);
}

// A recording that was recorded to its end.
void record(const fs::path& folder, bool finish = true, bool only_segments = false) {
  RecordingInfo info;
  if (only_segments) info.segments = {{"kept", 0, 250'000 * std::int64_t{kRows / 2}}};
  RecordingAppender appender(folder, info, any_calibration(), {});
  for (int i = 0; i < kRows; ++i) appender.add(probe_sample(i));
  for (int i = 0; i < 90; ++i) {
    TrackerSample pose;
    pose.t_ns = 22'000'000 * std::int64_t{i};
    pose.T_world_marker.translation_m = {0.001 * i, 0.1, 0.2};
    appender.add(pose);
  }
  if (finish) appender.finish(info, only_segments);
}

std::string text_of(const fs::path& path) { return read_file(path, 1 << 24); }

std::vector<std::string> kinds(const Recording& recording) {
  std::vector<std::string> out;
  for (const Problem& problem : recording.problems) out.push_back(problem.kind);
  return out;
}

// The start of the line with this number, from 1.
std::size_t line_start(const std::string& text, int line) {
  std::size_t at = 0;
  for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
  return at;
}

// By the format alone: what a reader with zip's CRC-32 at hand would do.
TEST(Checksums, EveryByteLiesInABlockWhoseCrcIsAsListed) {
  const testkit::TempDir dir;
  for (const bool only_segments : {false, true}) {
    const fs::path folder = dir / (only_segments ? "cut" : "whole");
    record(folder, true, only_segments);
    std::ifstream list(folder / "checksums.txt");
    std::string line, file, crc;
    std::map<std::string, std::uint64_t> end;
    std::getline(list, line);
    EXPECT_THAT(line, testing::StartsWith("#"));
    std::uint64_t begin = 0, bytes = 0;
    int blocks = 0;
    while (list >> file >> begin >> bytes >> crc) {
      const std::string text = text_of(folder / file);
      EXPECT_EQ(begin, end[file]);
      EXPECT_EQ(crc32(std::string_view(text).substr(begin, bytes)), std::stoul(crc, nullptr, 16));
      end[file] = begin + bytes;
      EXPECT_EQ(text[begin + bytes - 1], '\n');
      ++blocks;
    }
    EXPECT_EQ(end["probe.csv"], fs::file_size(folder / "probe.csv"));
    EXPECT_EQ(end["tracker.csv"], fs::file_size(folder / "tracker.csv"));
    EXPECT_GE(blocks, 3);
    EXPECT_TRUE(read_recording(folder).problems.empty());
  }
}

TEST(Checksums, ADigitThatChangedIsReportedWithItsLines) {
  const testkit::TempDir dir;
  record(dir / "rec");
  std::string text = text_of(dir / "rec/probe.csv");
  const std::size_t at = line_start(text, 4000) - 2;  // the last digit of the line before
  text[at] = text[at] == '5' ? '6' : '5';
  write_file(dir / "rec/probe.csv", text);
  const Recording recording = read_recording(dir / "rec");
  ASSERT_THAT(kinds(recording), testing::ElementsAre("changed"));
  EXPECT_THAT(recording.problems[0].message, HasSubstr("not the bytes that were recorded"));
  EXPECT_LT(recording.problems[0].count, 4000u);

  const testkit::TempDir saved;
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
  EXPECT_EQ(recovered.probe.changed_rows, recording.problems[0].count);
  EXPECT_EQ(recovered.probe.rows + recovered.probe.changed_rows, std::size_t{kRows});
  EXPECT_EQ(recovered.tracker.rows, 90u);
  EXPECT_FALSE(recovered.lost_nothing());
  EXPECT_TRUE(read_recording(saved.path()).problems.empty());
}

// Rows gone, rows come in between: what lies behind is still known to be whole.
TEST(Checksums, WhatLiesBehindMissingOrForeignBytesIsFoundAgain) {
  const testkit::TempDir dir;
  record(dir / "rec");
  const std::string whole = text_of(dir / "rec/probe.csv");
  const std::size_t at = line_start(whole, 3000), to = line_start(whole, 3100);
  for (const std::string& text :
       {whole.substr(0, at) + whole.substr(to), whole.substr(0, at) + "1,2\n" + whole.substr(at)}) {
    write_file(dir / "rec/probe.csv", text);
    const testkit::TempDir saved;
    const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
    EXPECT_GT(recovered.probe.rows, 4500u);
    EXPECT_GT(recovered.probe.changed_rows, 1000u);
    EXPECT_TRUE(text_of(saved.path() / "probe.csv").ends_with(whole.substr(line_start(whole, 7900))));
  }
}

TEST(Checksums, AStreamCutShortIsReported) {
  const testkit::TempDir dir;
  record(dir / "rec");
  const std::string whole = text_of(dir / "rec/probe.csv");
  write_file(dir / "rec/probe.csv", whole.substr(0, line_start(whole, 3000)));
  EXPECT_THAT(kinds(read_recording(dir / "rec")), testing::ElementsAre("changed"));
}

TEST(Checksums, WithoutThemARecordingReadsAsBefore) {
  const testkit::TempDir dir;
  record(dir / "rec");
  fs::remove(dir / "rec/checksums.txt");
  EXPECT_TRUE(read_recording(dir / "rec").problems.empty());
  // Nor does a list that is damaged itself stop anything.
  write_file(dir / "rec/checksums.txt", "probe.csv 0 18446744073709551615 zz\nprobe.csv -1 3 00000000\n\0x\xff");
  EXPECT_TRUE(read_recording(dir / "rec").problems.empty());
}

TEST(Recover, SavesTheRowsThatAreRows) {
  const testkit::TempDir dir;
  record(dir / "rec");
  fs::remove(dir / "rec/checksums.txt");
  std::string text = text_of(dir / "rec/probe.csv");
  const std::size_t at = line_start(text, 5000);
  for (std::size_t i = at; i < at + 500; ++i) text[i] = '\0';  // a sector that was never written
  write_file(dir / "rec/probe.csv", text);
  EXPECT_THROW(read_recording(dir / "rec"), Error);
  const testkit::TempDir saved;
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
  EXPECT_EQ(recovered.probe.unreadable_rows, 1u);
  EXPECT_GT(recovered.probe.rows, std::size_t{kRows - 30});
  EXPECT_THAT(recovered.probe.messages, testing::ElementsAre("probe.csv:5000: not a row of this file; left out"));
  const Recording recording = read_recording(saved.path());
  EXPECT_EQ(recording.probe.size(), recovered.probe.rows);
  EXPECT_EQ(recording.info.extra["recovered"]["probe"]["unreadable_rows"].get<int>(), 1);
}

TEST(Recover, SaysThatRowsAreMissingWhereNoneIsLeftToShowIt) {
  const testkit::TempDir dir;
  record(dir / "rec");
  const std::string whole = text_of(dir / "rec/probe.csv");
  std::ifstream list(dir / "rec/checksums.txt");
  std::string line, file;
  std::getline(list, line);
  std::uint64_t begin = 0, bytes = 0;
  list >> file >> begin >> bytes;
  const std::size_t edge = begin + bytes;  // of the first block
  const std::size_t next = whole.find('\n', edge + 70'000) + 1;
  for (const std::string& text : {whole.substr(0, edge), whole.substr(0, whole.size() - 1), whole.substr(0, next)}) {
    write_file(dir / "rec/probe.csv", text);
    const testkit::TempDir saved;
    const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
    EXPECT_FALSE(recovered.lost_nothing()) << text.size();
    EXPECT_FALSE(recovered.probe.messages.empty());
  }
}

TEST(Recover, WithoutChecksumsNothingIsSaidToBeWhole) {
  const testkit::TempDir dir;
  record(dir / "rec");
  const testkit::TempDir checked, unchecked;
  EXPECT_TRUE(recover_recording(dir / "rec", checked.path()).lost_nothing());
  fs::remove(dir / "rec/checksums.txt");
  EXPECT_FALSE(recover_recording(dir / "rec", unchecked.path()).lost_nothing());
}

TEST(Recover, AHeaderThatReadsIsKept) {
  const testkit::TempDir dir;
  record(dir / "rec");
  fs::remove(dir / "rec/checksums.txt");
  write_file(dir / "rec/probe.csv",
             "# by hand\nforce, accel_k ,accel_j,accel_i,t_ns\n1, 2,3,4,5\n6,7,8,9,10\n6,7,8,9,x\n");
  const testkit::TempDir saved;
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
  EXPECT_FALSE(recovered.probe.header_replaced);
  EXPECT_EQ(recovered.probe.rows, 2u);
  EXPECT_EQ(recovered.probe.unreadable_rows, 1u);
  EXPECT_EQ(text_of(saved.path() / "probe.csv"), "force, accel_k ,accel_j,accel_i,t_ns\n1, 2,3,4,5\n6,7,8,9,10\n");
  // A column that is spelt wrongly is one that no reader finds.
  write_file(dir / "rec/probe.csv", "t_ns,accel_X,accel_j,accel_k,force\n1,2,3,4,5\n");
  const testkit::TempDir again;
  EXPECT_TRUE(recover_recording(dir / "rec", again.path()).probe.header_replaced);
}

TEST(Recover, AnUnreadableHeaderIsToldByTheColumns) {
  const testkit::TempDir dir;
  record(dir / "rec");
  std::string text = text_of(dir / "rec/tracker.csv");
  text[0] = '\xff';
  write_file(dir / "rec/tracker.csv", text);
  const testkit::TempDir saved;
  RecoverOptions options;
  options.keep_changed = true;
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path(), options);
  EXPECT_TRUE(recovered.tracker.header_replaced);
  EXPECT_EQ(recovered.tracker.rows, 90u);
  EXPECT_EQ(read_recording(saved.path()).tracker.size(), 90u);
}

TEST(Recover, AnUnreadableJsonComesFromAnotherTake) {
  const testkit::TempDir dir;
  record(dir / "rec");
  record(dir / "other");
  write_file(dir / "rec/calibration.json", "{\"format\":");
  const testkit::TempDir saved;
  try {
    recover_recording(dir / "rec", saved.path());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("calibration.json"));
    EXPECT_THAT(error.what(), HasSubstr("--like"));
  }
  RecoverOptions options;
  options.like = dir / "other";
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path(), options);
  EXPECT_THAT(recovered.taken_from_like, testing::ElementsAre("calibration.json"));
  EXPECT_EQ(read_recording(saved.path()).probe.size(), std::size_t{kRows});
}

// Cut anywhere, flipped anywhere: what is saved is a recording whose rows are rows of the one that was recorded.
TEST(Recover, NeverInventsARow) {
  const testkit::TempDir dir;
  record(dir / "rec");
  const std::string whole = text_of(dir / "rec/probe.csv");
  Random random(7);
  for (int trial = 0; trial < 12; ++trial) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size() - 1)));
      if (trial % 3 == 0) text[at] = static_cast<char>(random.bits());
      if (trial % 3 == 1) text.erase(at, 1 + random.bits() % 5000);
      if (trial % 3 == 2) text.insert(at, std::string(1 + random.bits() % 50, static_cast<char>(random.bits())));
    }
    write_file(dir / "rec/probe.csv", text);
    const testkit::TempDir saved;
    RecoveredRecording recovered;
    ASSERT_NO_THROW(recovered = recover_recording(dir / "rec", saved.path())) << trial;
    const std::string kept = text_of(saved.path() / "probe.csv");
    std::size_t from = 0;
    for (std::size_t at = 0; at < kept.size();) {
      const std::size_t end = kept.find('\n', at) + 1;
      const std::size_t place = whole.find(kept.substr(at, end - at), from);
      ASSERT_NE(place, std::string::npos) << trial << ": " << kept.substr(at, end - at);
      ASSERT_TRUE(place == 0 || whole[place - 1] == '\n');
      from = place + (end - at);
      at = end;
    }
  }
}

TEST(ReadRecording, ALinkOutOfTheFolderIsNotFollowed) {
  const testkit::TempDir dir;
  record(dir / "rec");
  fs::rename(dir / "rec/probe.csv", dir / "elsewhere.csv");
  fs::create_symlink(dir / "elsewhere.csv", dir / "rec/probe.csv");
  try {
    read_recording(dir / "rec");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("link out of the recording"));
  }
  // One that stays inside is a name like any other.
  fs::remove(dir / "rec/probe.csv");
  fs::rename(dir / "elsewhere.csv", dir / "rec/raw.csv");
  fs::create_symlink("raw.csv", dir / "rec/probe.csv");
  EXPECT_NO_THROW(read_recording(dir / "rec"));
}

TEST(ReadRecording, NoFileOfARecordingIsALinkOut) {
  const testkit::TempDir dir;
  record(dir / "rec");
  fs::create_directory(dir / "other");
  for (const char* name : {"recording.json", "calibration.json", "probe.csv", "tracker.csv", "checksums.txt"}) {
    const fs::path file = dir / "rec" / name;
    fs::rename(file, dir / "other" / name);
    // By its whole path, by one that climbs, and by a link within that leads on to one outside.
    for (const fs::path& target : {dir / "other" / name, fs::path("../other") / name, fs::path("hop")}) {
      if (target == "hop") fs::create_symlink(fs::path("..") / "other" / name, dir / "rec/hop");
      fs::create_symlink(target, file);
      EXPECT_THAT([&] { read_recording(dir / "rec"); },
                  testing::ThrowsMessage<Error>(HasSubstr(std::string(name) + ": is a link out of the recording")));
      fs::remove(file);
    }
    fs::remove(dir / "rec/hop");
    fs::rename(dir / "other" / name, file);
  }
  fs::create_symlink("/etc/passwd", dir / "rec/truth.csv");
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, testing::ThrowsMessage<Error>(HasSubstr("truth.csv: is a link")));
  fs::remove(dir / "rec/truth.csv");
  // The recording itself may be reached by a link: that one the user named.
  fs::create_directory_symlink("rec", dir / "named");
  EXPECT_NO_THROW(read_recording(dir / "named"));
}

}  // namespace
}  // namespace asperity
