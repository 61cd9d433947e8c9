// A command, as docs/architecture.md tells to add one.
#include <gmock/gmock.h>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"
#include "command.h"
#include "manual_page.h"
#include "shell_completion.h"

namespace asperity::app {
namespace {

// apps/asperity/cmd_lines.cc -----------------------------------------------------------------------------------------

struct LinesConfig {
  int skip = 0;

  template <class V>
  void visit(V& v) {
    v.field("skip", skip, "lines at the start that do not count", {0, 1000});
  }
};

class LinesCommand : public Command {
 public:
  explicit LinesCommand(Parser& root) : Command(root, "lines", "Counts the lines of a file") {
    require(parser().add_option("FILE", file_, "A text"));
  }

  std::vector<ConfigField> fields() override { return list_fields("lines", config_); }

  int run(const Observer&) override {
    constexpr std::uint64_t kLargest_bytes = 1 << 20;
    int lines = -config_.skip;
    for (const char c : read_file(file_, kLargest_bytes)) lines += c == '\n' ? 1 : 0;
    print_json("{\"lines\": " + std::to_string(lines) + "}");
    say(std::to_string(lines) + " lines\n");
    return kDone;
  }

 private:
  std::string file_;
  LinesConfig config_;
};

// Declared in commands.h, and in the list of main.cc.
std::unique_ptr<Command> make_lines(Parser& root) { return std::make_unique<LinesCommand>(root); }

// --------------------------------------------------------------------------------------------------------------------

// The program with this command alone, at `words` of a command line.
struct Program {
  Parser root{"asperity", ""};
  std::unique_ptr<Command> command = make_lines(root);

  explicit Program(std::vector<std::string> words) {
    words.insert(words.begin(), {"asperity", "lines"});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    const ParsedLine line = root.parse(static_cast<int>(argv.size()), argv.data());
    EXPECT_EQ(line.kind, ParsedLine::Kind::kCommand) << line.text;
    EXPECT_TRUE(command->parser().is_parsed());
  }
};

// What the command writes to standard output.
std::string output_of(const std::vector<std::string>& words) {
  Program program(words);
  testing::internal::CaptureStdout();
  if (program.command->resolve()) {
    EXPECT_EQ(program.command->run({}), kDone);
  }
  return testing::internal::GetCapturedStdout();
}

TEST(AddingACommand, ItHasItsOptionsItsSettingsAndTheCommonOnes) {
  const testkit::TempDir folder;
  const std::string file = (folder / "text").string();
  write_file(file, "one\ntwo\nthree\n");
  EXPECT_EQ(output_of({file}), "3 lines\n");
  EXPECT_EQ(output_of({file, "--json", "--set", "lines.skip=1"}), "{\"lines\": 2}\n");
  EXPECT_THAT(output_of({"--print-config"}), testing::HasSubstr("skip = 0"));
  EXPECT_THROW(Program({}).command->resolve(), UsageError);
}

TEST(AddingACommand, ItIsInTheManualAndInTheCompletions) {
  Parser root("asperity", "");
  const std::unique_ptr<Command> command = make_lines(root);
  EXPECT_THAT(manual_page(root), testing::HasSubstr("Counts the lines of a file"));
  EXPECT_THAT(shell_completion("bash", root, {}), testing::HasSubstr("lines"));
}

// Values of an option are completed because it declares them, whether the parser checks them or the command does.
TEST(AddingACommand, TheValuesOfAnOptionAreCompletedForThisCommand) {
  Parser root("asperity", "");
  const std::unique_ptr<Command> command = make_lines(root);
  std::string end, unit;
  command->parser().add_option("-e,--end", end, "How a line ends")->one_of({"lf", "crlf"});
  command->parser().add_option("--unit", unit, "Of the count")->suggest(std::vector<std::string>{"one", "dozen"});
  EXPECT_THAT(shell_completion("bash", root, {}),
              testing::HasSubstr("\"lines --end\" | \"lines -e\") values=\"lf crlf\""));
  EXPECT_THAT(shell_completion("bash", root, {}), testing::HasSubstr("\"lines --unit\") values=\"one dozen\""));
  EXPECT_THAT(shell_completion("zsh", root, {}), testing::HasSubstr("\"lines --unit\") values=(one dozen)"));
  EXPECT_THAT(shell_completion("fish", root, {}), testing::HasSubstr("from lines' -l unit -a 'one dozen' -r"));
  std::string program = "asperity", name = "lines", option = "--end", value = "cr";
  std::array<char*, 4> words{program.data(), name.data(), option.data(), value.data()};
  EXPECT_EQ(root.parse(4, words.data()).kind, ParsedLine::Kind::kFault);
}

}  // namespace
}  // namespace asperity::app
