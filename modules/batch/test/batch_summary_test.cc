#include "asperity/batch/batch_summary.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResult =
    R"({"profile":{"length_m":0.08,"length_stderr_m":0.0001,"snr":null},"roughness":{"Ra_m":4e-6,"Ra_stderr_m":1e-7},)"
    R"("periodicity":{"periodic":false,"pitch_m":0.001},"friction":{"determined":true,"coefficient":0.3},)"
    R"("verdicts":[{"code":"clipped","severity":"limited","message":"3 % clipped","remedy":""}]})";

std::string cell(const SummaryRow& row, const std::string& column) {
  const std::vector<std::string> columns = summary_columns();
  const auto at = std::find(columns.begin(), columns.end(), column);
  return row.cells.at(static_cast<std::size_t>(at - columns.begin()));
}

TEST(BatchSummary, TakesWhatIsDeterminedWithItsErrors) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "s/a/process");
  write_file(dir / "s/a/process/result.json", kResult);
  const auto rows = summarise_scan({"s/a", "rec/a", {{"process", {}, "", 0, ""}}}, dir.path());
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status, "limited");
  EXPECT_EQ(rows[0].message, "3 % clipped");
  EXPECT_EQ(rows[0].codes, std::vector<std::string>{"limited:clipped"});
  EXPECT_EQ(cell(rows[0], "length_m"), "0.08");
  EXPECT_EQ(cell(rows[0], "Ra_stderr_m"), "1e-07");
  EXPECT_EQ(cell(rows[0], "pitch_m"), "") << "it is not periodic";
  EXPECT_EQ(cell(rows[0], "friction"), "0.3");
  EXPECT_EQ(cell(rows[0], "snr"), "");
}

TEST(BatchSummary, ALaterStepThatIsNotToBeTrustedMakesTheRowSo) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "a/process");
  fs::create_directories(dir / "a/register");
  write_file(dir / "a/process/result.json", "{}");
  write_file(dir / "a/register/registration.json", "{}");
  const auto rows =
      summarise_scan({"a", "rec", {{"process", {}, "", 0, ""}, {"register", {}, "", 3, "two poses fit"}}}, dir.path());
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status, "invalid");
  EXPECT_EQ(rows[0].message, "register: two poses fit");
}

TEST(BatchSummary, ADamagedResultIsAFailure) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "a/process");
  write_file(dir / "a/process/result.json", R"({"profile":{"length_m":0.08)");
  const auto rows = summarise_scan({"a", "rec", {{"process", {}, "", 0, ""}}}, dir.path());
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status, "failed");
  EXPECT_NE(rows[0].message.find("result.json:1:"), std::string::npos) << rows[0].message;
  write_file(dir / "a/process/result.json", R"({"verdicts":["invalid"]})");
  EXPECT_EQ(summarise_scan({"a", "rec", {{"process", {}, "", 0, ""}}}, dir.path())[0].status, "failed");
}

TEST(BatchSummary, ThePosesVerdictsCountWhereTheBatchRegistered) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "a/process");
  fs::create_directories(dir / "a/register");
  write_file(dir / "a/process/result.json", "{}");
  write_file(dir / "a/register/registration.json",
             R"({"rms_m":1e-4,"verdicts":[{"code":"runner_up","severity":"limited","message":"two poses"}]})");
  const auto rows = summarise_scan({"a", "rec", {{"process", {}, "", 0, ""}, {"register", {}, "", 0, ""}}}, dir.path());
  EXPECT_EQ(rows[0].status, "limited");
  EXPECT_EQ(rows[0].message, "register: two poses");
  EXPECT_EQ(rows[0].codes, std::vector<std::string>{"limited:runner_up"});
  EXPECT_EQ(cell(rows[0], "registration_rms_m"), "1e-04");
  // From an earlier plan.
  const auto without = summarise_scan({"a", "rec", {{"process", {}, "", 0, ""}}}, dir.path());
  EXPECT_EQ(without[0].status, "valid");
  EXPECT_EQ(cell(without[0], "registration_rms_m"), "");
}

// process ends with 3 if one segment is invalid.
TEST(BatchSummary, AnInvalidSegmentLeavesTheOthersAsTheyAre) {
  const testkit::TempDir dir;
  for (const char* segment : {"one", "two"}) fs::create_directories(dir / "a/process" / segment);
  write_file(dir / "a/process/one/result.json",
             R"({"verdicts":[{"code":"nothing_touched","severity":"invalid","message":"nothing was touched"}]})");
  write_file(dir / "a/process/two/result.json", R"({"verdicts":[]})");
  ScanRecord record{"a", "rec", {{"process", {}, "", 3, "x"}}};
  auto rows = summarise_scan(record, dir.path());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].status, "invalid");
  EXPECT_EQ(rows[0].message, "nothing was touched");
  EXPECT_EQ(rows[1].status, "valid");
  record.steps.push_back({"roughness two", {}, "", 3, "too short"});
  rows = summarise_scan(record, dir.path());
  EXPECT_EQ(rows[0].message, "nothing was touched");
  EXPECT_EQ(rows[1].message, "roughness two: too short");
}

TEST(BatchSummary, FailuresAndSegmentsHaveRows) {
  const testkit::TempDir dir;
  const auto failed = summarise_scan({"a", "rec", {{"process", {}, "", 1, "line 3"}}}, dir.path());
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0].status, "failed");
  EXPECT_EQ(failed[0].failed_step, "process");
  EXPECT_EQ(summarise_scan({"b", "rec", {}}, dir.path())[0].failed_step, "not begun");
  EXPECT_EQ(summarise_scan({"c", "rec", {{"process", {}, "", 0, ""}}}, dir.path())[0].message, "its results are gone");
  for (const char* segment : {"one", "two"}) {
    fs::create_directories(dir / "d/process" / segment);
    write_file(dir / "d/process" / segment / "result.json", "{}");
  }
  const auto rows = summarise_scan({"d", "rec", {{"process", {}, "", 0, ""}}}, dir.path());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].name, "d/two");
}

TEST(BatchSummary, CellsAreQuotedAndEscaped) {
  SummaryRow row;
  row.name = "a,\"b\"<i>";
  row.status = "failed";
  row.message = "line\nbreak & <b>";
  row.cells.resize(summary_columns().size());
  const std::string csv = format_summary_csv({row});
  EXPECT_NE(csv.find("\"a,\"\"b\"\"<i>\",,failed,,,\"line\nbreak & <b>\","), std::string::npos) << csv;
  const std::string page = format_summary_page({row});
  EXPECT_NE(page.find("a,&quot;b&quot;&lt;i&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<i>"), std::string::npos);
  EXPECT_NE(page.find("&amp; &lt;b&gt;"), std::string::npos);
}

}  // namespace
}  // namespace asperity
