#include <gmock/gmock.h>

#include <string>

#include "asperity/base/base64.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/block.h"
#include "asperity/studio/format_report.h"
#include "asperity/studio/read_report_item.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/web/assets.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kResult = R"({"format":"asperity-result","version":1,"recording":"rec","length_m":0.001})";
constexpr const char* kProfile = "s_m,height_m,sigma_m\n0,nan,nan\n0.001,0.5,0.25\n";

fs::path write_result(const fs::path& folder, const std::string& result = kResult,
                      const std::string& profile = kProfile) {
  fs::create_directories(folder);
  write_file(folder / "result.json", result);
  write_file(folder / "profile.csv", profile);
  return folder;
}

std::string error_of(const fs::path& folder) {
  try {
    read_report_item(folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// The block's text, without its numbers.
std::string head_of(const std::string& block) { return block.substr(0, block.find("]}")); }

// The examples of RFC 4648, §10.
TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFB\xFF"), "+/8=");
}

TEST(Base64, IsReadBack) {
  for (const char* bytes : {"", "f", "fo", "foo", "foob", "\xFB\xFF"})
    EXPECT_EQ(bytes_of_base64(base64(bytes)), std::string(bytes));
  for (const char* bad : {"A", "AAA", "A===", "AB=C", "====", "AA\nA", "<b>="})
    EXPECT_EQ(bytes_of_base64(bad), std::nullopt) << bad;
}

TEST(ReportItem, HoldsWhatTheFilesHold) {
  const testkit::TempDir dir;
  write_result(dir / "rec");
  write_file(dir / "rec" / "trajectory.csv", "t_ns,px_m,py_m,pz_m\n5,1,2,3\n1000000005,4,5,6\n");
  const ReportItem item = read_report_item(dir / "rec");
  EXPECT_EQ(item.name, "rec");
  EXPECT_THAT(head_of(item.block), HasSubstr(R"("samples":2,"every":1,"points":2)"));
  EXPECT_THAT(head_of(item.block), HasSubstr(R"("length_m":0.001)"));
  EXPECT_THAT(head_of(item.block), HasSubstr(R"({"name":"trajectory_p_m","type":"f32","shape":[2,3])"));
  EXPECT_EQ(item.block, read_report_item(dir / "rec").block);
  const float path_m[] = {-3, -3, -3, 0, 0, 0};  // from the middle one
  EXPECT_NE(item.block.find(std::string(reinterpret_cast<const char*>(path_m), sizeof path_m)), std::string::npos);
}

TEST(ReportItem, NeedsNoTrajectory) {
  const testkit::TempDir dir;
  EXPECT_THAT(read_report_item(write_result(dir / "rec"), "other").block.substr(0, 2000),
              HasSubstr(R"("trajectory":{"samples":0)"));
}

TEST(ReportItem, ThinsALongPath) {
  const testkit::TempDir dir;
  write_result(dir / "rec");
  std::string rows = "t_ns,px_m,py_m,pz_m\n";
  for (int i = 0; i < 50'001; ++i) rows += std::to_string(i) + ",0,0," + std::to_string(i) + "\n";
  write_file(dir / "rec" / "trajectory.csv", rows);
  const ReportItem item = read_report_item(dir / "rec");
  EXPECT_THAT(head_of(item.block), HasSubstr(R"("samples":50001,"every":3)"));
  EXPECT_THAT(head_of(item.block), HasSubstr(R"("shape":[16667,3])"));  // every third
}

// What `process` has put into its report and into no other file is not lost when the report is made again.
TEST(ReportItem, KeepsWhatTheReportOfTheSameResultHolds) {
  if (!web::built()) return;
  const testkit::TempDir dir;
  write_result(dir / "rec");
  BlockWriter fuller("measured");
  fuller.head()["result"] = parse_json(kResult);
  fuller.add("compliance_ratio", std::vector<double>{1.0});
  const std::string block = fuller.take();
  write_file(dir / "rec" / "report.html", format_report({{"other", "no block"}, {"rec", block}}));
  EXPECT_EQ(read_report_item(dir / "rec", "named").block, block);
  EXPECT_EQ(read_report_item(dir / "rec", "named").name, "named");
  // Another result, or a report that is damaged: from the files.
  write_result(dir / "rec", R"({"format":"asperity-result","version":1,"recording":"rec","length_m":0.002})");
  EXPECT_NE(read_report_item(dir / "rec").block, block);
  write_result(dir / "rec");
  for (const std::string& page :
       {format_report({{"rec", block.substr(0, 40)}}), std::string("<script type=\"application/octet-stream\""),
        "<script type=\"application/octet-stream\">" + base64("ASB1\xFF\xFF\xFF\xFF") + "</script>"}) {
    write_file(dir / "rec" / "report.html", page);
    EXPECT_NE(read_report_item(dir / "rec").block, block);
  }
  // Beginnings without end are passed over together, and what follows them is found.
  const std::string begin = "<script type=\"application/octet-stream\"";
  std::string page;
  for (int i = 0; i < 20'000; ++i) page += begin;
  page += ">no block</script>" + begin + ">" + base64(block) + "</script>";
  write_file(dir / "rec" / "report.html", page);
  EXPECT_EQ(read_report_item(dir / "rec").block, block);
}

TEST(ReportItem, NamesWhatIsWrong) {
  const testkit::TempDir dir;
  EXPECT_THAT(error_of(write_result(dir / "a", "{")), HasSubstr("result.json:1:1: not JSON"));
  EXPECT_THAT(error_of(write_result(dir / "b", "[1]")), HasSubstr("is not a result of asperity process"));
  EXPECT_THAT(error_of(write_result(dir / "c", R"({"format":"asperity-result","version":2})")), HasSubstr("version 2"));
  EXPECT_THAT(error_of(write_result(dir / "d", std::string(50'000, '['))), HasSubstr("nested more than 32 deep"));
  EXPECT_THAT(error_of(write_result(dir / "e", kResult, "s_m,height_m\n0,x\n")),
              HasSubstr("profile.csv:2: column 'height_m'"));
  EXPECT_THAT(error_of(write_result(dir / "f", kResult, "s_m,height_m\n0,inf\n")), HasSubstr("is not finite"));
  EXPECT_THAT(error_of(write_result(dir / "g", kResult, "s_m\n0\n")), HasSubstr("height_m"));
  EXPECT_THROW(find_results(dir / "none"), Error);
  fs::create_directory(dir / "empty");
  EXPECT_THROW(find_results(dir / "empty"), Error);
}

TEST(ReportItem, AreFoundInTheFoldersOfSeveral) {
  const testkit::TempDir dir;
  write_result(dir / "out" / "b" / "contact_1");
  write_result(dir / "out" / "a");
  write_result(dir / "out" / ".hidden");
  EXPECT_THAT(find_results(dir / "out"), ElementsAre(dir / "out" / "a", dir / "out" / "b" / "contact_1"));
}

TEST(Report, IsOneFileThatLoadsNothing) {
  const std::vector<ReportItem> items{{"<b>&\"", "block"}, {"two", "another"}};
  if (!web::built()) {
    EXPECT_THROW(format_report(items), Error);
    return;
  }
  const std::string page = format_report(items);
  EXPECT_EQ(page, format_report(items));
  EXPECT_THAT(page, HasSubstr("<title>&lt;b&gt;&amp;&quot; and 1 more"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("<script type=\"application/octet-stream\" data-name=\"&lt;b&gt;&amp;&quot;\">" +
                              base64("block") + "</script>"));
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script"); at != std::string::npos; at = page.find("</script", at + 1)) ++ends;
  EXPECT_EQ(ends, 3u);
  EXPECT_THROW(format_report({}), Error);
}

}  // namespace
}  // namespace asperity::studio
