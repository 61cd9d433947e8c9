#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "wrong_inputs.h"

// No wrong input may come out as valid but those that docs/verdicts-wrong-inputs.md names: its table is run.
namespace asperity {
namespace {

struct Documented {
  std::string result;
  std::set<std::string> codes;
};

std::map<std::string, Documented> documented_rows() {
  std::ifstream file(VERDICTS_MD);
  std::map<std::string, Documented> out;
  std::string line;
  bool inside = false;
  const std::regex code("`([a-z_]+)`");
  while (std::getline(file, line)) {
    if (line.starts_with("## ")) inside = line == "## Wrong inputs";
    if (!inside || !line.starts_with("| ") || line.starts_with("| Stream")) continue;
    std::istringstream cells(line.substr(2));
    std::string group, what, result, rest;
    const auto cell = [&](std::string& text) {
      std::getline(cells, text, '|');
      text = std::regex_replace(text, std::regex("^ +| +$"), "");
    };
    cell(group);
    cell(what);
    cell(result);
    std::getline(cells, rest);
    Documented& row = out[group + ": " + what];
    row.result = result;
    for (std::sregex_iterator i(rest.begin(), rest.end(), code), end; i != end; ++i) row.codes.insert((*i)[1]);
  }
  return out;
}

TEST(WrongInputs, AreJudgedAsDocumented) {
  std::map<std::string, Documented> rows = documented_rows();
  for (const WrongInput& wrong : wrong_inputs("sine", "open", 1)) {
    const std::string name = wrong.group + ": " + wrong.what;
    const auto row = rows.find(name);
    if (row == rows.end()) {
      ADD_FAILURE() << name << " is not in docs/verdicts-wrong-inputs.md";
      continue;
    }
    std::set<std::string> codes;
    std::string result = "refused";
    try {
      const ProcessResult processed = process_recording(wrong.make(), ProcessConfig{});
      result = std::string(verdict_word(processed.verdicts));
      for (const Verdict& verdict : processed.verdicts) codes.insert(verdict.code);
    } catch (const Error&) {
    }
    EXPECT_EQ(result, row->second.result) << name;
    for (const std::string& code : row->second.codes) EXPECT_THAT(codes, testing::Contains(code)) << name;
    rows.erase(row);
  }
  EXPECT_TRUE(rows.empty()) << rows.begin()->first << " is documented and was not run";
}

}  // namespace
}  // namespace asperity
