#include "asperity/verdict/verdict.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "asperity/base/error.h"
#include "asperity/verdict/verdict_codes.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity {
namespace {

const Verdict kBad{"clipped", Severity::kInvalid, "30 % are clipped", "scan slower"};
const Verdict kWorse{"rows_lost", Severity::kInvalid, "8 of 9 rows are lost", ""};
const Verdict kSoSo{"no_roughness", Severity::kLimited, "there is no roughness", "scan longer"};
const Verdict kKnown{"some_note", Severity::kNote, "two gaps", ""};

TEST(Verdict, TheWorstDecides) {
  EXPECT_EQ(verdict_word({}), "valid");
  EXPECT_EQ(verdict_word({kKnown}), "valid");
  EXPECT_EQ(verdict_word({kKnown, kSoSo}), "limited");
  EXPECT_EQ(verdict_word({kSoSo, kBad, kKnown}), "invalid");
  EXPECT_TRUE(is_trustworthy({kKnown, kSoSo}));
  EXPECT_FALSE(is_trustworthy({kKnown, kSoSo, kBad}));
}

TEST(Verdict, ASentenceNamesTheWorstOnly) {
  EXPECT_EQ(verdict_sentence({}), "");
  EXPECT_EQ(verdict_sentence({kKnown}), "");
  EXPECT_EQ(verdict_sentence({kKnown, kSoSo}), "limited: there is no roughness; scan longer");
  EXPECT_EQ(verdict_sentence({kSoSo, kBad, kKnown, kWorse}),
            "invalid: 30 % are clipped; scan slower. 8 of 9 rows are lost");
  EXPECT_EQ(verdict_line(kWorse), "invalid: 8 of 9 rows are lost (asperity help rows_lost)");
}

TEST(Verdict, IsSortedAndNamed) {
  Verdicts all{kKnown, kSoSo, kBad, kWorse};
  sort_verdicts(all);
  EXPECT_EQ(all, (Verdicts{kBad, kWorse, kSoSo, kKnown}));
  Verdicts of_two{kBad};
  append_verdicts(of_two, {kSoSo}, "scan2");
  EXPECT_EQ(of_two.back().message, "scan2: there is no roughness");
}

TEST(Verdict, InJsonHasItsFourParts) {
  EXPECT_EQ(
      verdicts_json({kSoSo}).dump(),
      R"([{"code":"no_roughness","severity":"limited","message":"there is no roughness","remedy":"scan longer"}])");
  EXPECT_EQ(verdicts_json({}).dump(), "[]");
}

TEST(VerdictCodes, AreDistinctSnakeCaseAndSayWhatToDo) {
  std::set<std::string_view> codes;
  for (const VerdictCode& entry : verdict_codes()) {
    EXPECT_TRUE(codes.insert(entry.code).second) << entry.code;
    EXPECT_THAT(std::string(entry.code), testing::MatchesRegex("[a-z]+(_[a-z]+)*"));
    EXPECT_TRUE(!entry.remedy.empty() || entry.severity == Severity::kNote) << entry.code;
  }
  EXPECT_THROW(make_verdict("no_such_code", ""), Error);
}

// docs/verdicts.md has a row of each code, with its severity, and no other.
TEST(VerdictCodes, AreDocumented) {
  const auto file = std::filesystem::path(ASPERITY_TEST_DATA) / "../../../../docs/verdicts.md";
  std::ifstream in(file.lexically_normal());
  ASSERT_TRUE(in) << file;
  std::map<std::string, std::string> documented;
  for (std::string line; std::getline(in, line);) {
    const std::size_t end = line.find("` | ", 3);
    const std::size_t severity_end = end == std::string::npos ? end : line.find(" | ", end + 4);
    if (!line.starts_with("| `") || severity_end == std::string::npos) continue;
    documented[line.substr(3, end - 3)] = line.substr(end + 4, severity_end - end - 4);
  }
  for (const std::string_view severity : kSeverityNames) documented.erase(std::string(severity));
  std::map<std::string, std::string> codes;
  for (const VerdictCode& entry : verdict_codes())
    codes[std::string(entry.code)] = kSeverityNames.at(static_cast<std::size_t>(entry.severity));
  EXPECT_EQ(documented, codes);
}

}  // namespace
}  // namespace asperity
