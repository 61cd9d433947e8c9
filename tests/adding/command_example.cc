// A command, as docs/architecture.md tells to add one.
#include <gmock/gmock.h>
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

// What the command writes to standard output.
std::string output_of(std::vector<std::string> words) {
  Parser root("asperity", "");
  const std::unique_ptr<Command> command = make_lines(root);
  words.insert(words.begin(), {"asperity", "lines"});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  const ParsedLine line = root.parse(static_cast<int>(argv.size()), argv.data());
  EXPECT_EQ(line.kind, ParsedLine::Kind::kCommand) << line.text;
  EXPECT_TRUE(command->parser().is_parsed());
  testing::internal::CaptureStdout();
  if (command->resolve()) {
    EXPECT_EQ(command->run({}), kDone);
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
  EXPECT_THROW(output_of({}), UsageError);
}

TEST(AddingACommand, ItIsInTheManualAndInTheCompletions) {
  Parser root("asperity", "");
  const std::unique_ptr<Command> command = make_lines(root);
  EXPECT_THAT(manual_page(root), testing::HasSubstr("Counts the lines of a file"));
  EXPECT_THAT(shell_completion("bash", root), testing::HasSubstr("lines"));
}

}  // namespace
}  // namespace asperity::app
