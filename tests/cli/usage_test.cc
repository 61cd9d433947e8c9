#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "asperity/web/assets.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::vector<std::string> kCommands{"demo", "simulate", "import", "inspect",   "process", "roughness",
                                         "feel", "record",   "track",  "check-rig", "report"};

TEST(Usage, VersionAndHelp) {
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, StartsWith("asperity "));
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const auto& command : kCommands) {
    EXPECT_THAT(help.out, HasSubstr("\n  " + command + " "));
    const Outcome one = run({command, "--help"});
    EXPECT_EQ(one.code, 0) << command;
    EXPECT_THAT(one.out, HasSubstr("Usage: asperity " + command));
    for (const char* option : {"--json", "--config", "--set", "--print-config", "--quiet"}) {
      EXPECT_THAT(one.out, HasSubstr(option)) << command;
    }
  }
}

TEST(Usage, TheStudioIsThereOrSaysWhyNot) {
  const testkit::TempDir dir;
  const Outcome outcome = run({"studio", (dir / "none").string(), "--no-open"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(web::built() ? "none: no such file or folder" : "built without the studio. "));
  EXPECT_EQ(web::why_not_built().empty(), web::built());
  if (!web::built()) {
    EXPECT_THAT(outcome.err, HasSubstr(std::string(web::why_not_built()) + ", and build again"));
  }
}

TEST(Usage, HelpOfACodeIsItsRowOfTroubleshooting) {
  const Outcome verdict = run({"help", "below_noise"});
  EXPECT_EQ(verdict.code, 0);
  EXPECT_THAT(verdict.out, StartsWith("below_noise (invalid)\n"));
  EXPECT_THAT(verdict.out, HasSubstr("What to do: "));
  EXPECT_THAT(verdict.out, HasSubstr("docs/troubleshooting.md#below_noise\n"));
  const Outcome code = run({"help", "exit-3"});
  EXPECT_EQ(code.code, 0);
  EXPECT_THAT(code.out, StartsWith("exit-3\n"));
  const Outcome none = run({"help", "no_such_code"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.out, IsEmpty());
}

TEST(Usage, NamesReachTheTerminalEscaped) {
  const Outcome outcome = run({"roughness", "no\x1b[31mfile.txt", "--spacing", "1um"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no\\x1b[31mfile.txt"));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("\x1b")));
}

TEST(Usage, WrongCommandLinesEndWith2AndOneHint) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"no-such-command"},
                                             {"--no-such-option"},
                                             {"roughness"},
                                             {"roughness", "x", "--no-such-option"},
                                             {"roughness", "x", "--spacing", "0.5"},
                                             {"roughness", "x", "--spacing", "0.5 parsec"},
                                             {"roughness", "x", "--set", "roughness.sections"},
                                             {"--completion", "tcsh"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << ::testing::PrintToString(arguments);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr("--help"));
  }
}

TEST(Usage, BareItSaysWhereToBegin) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("asperity demo"));
  EXPECT_THAT(outcome.out, HasSubstr("asperity studio"));
  EXPECT_THAT(outcome.out, HasSubstr("asperity help COMMAND"));
}

TEST(Usage, HelpOfACommandIsThatCommandsHelp) {
  for (const char* command : {"process", "roughness"})
    EXPECT_EQ(run({"help", command}).out, run({command, "--help"}).out);
  EXPECT_EQ(run({"help", "texture", "fit"}).out, run({"texture", "fit", "--help"}).out);
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  const Outcome unknown = run({"help", "proces"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean process?"));
}

TEST(Usage, AMistypedWordNamesTheNearest) {
  const auto error = [](const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_THAT(error({"proces", "rec"}), HasSubstr("'proces' is not a command; did you mean process?"));
  EXPECT_THAT(error({"texture", "fitt"}), HasSubstr("did you mean fit?"));
  EXPECT_THAT(error({"roughness", "x", "--lamda-c=0.8mm"}),
              HasSubstr("'--lamda-c' is not an option; did you mean --lambda-c?"));
  EXPECT_THAT(error({"hlep", "process"}), HasSubstr("did you mean help?"));
  EXPECT_THAT(error({"export", "t.texture.json", "--to", "glb"}), HasSubstr("did you mean gltf?"));
  EXPECT_THAT(error({"export", "t.texture.json", "--to", "ussda"}), HasSubstr("did you mean usda?"));
  EXPECT_THAT(error({"inspect", "one", "two"}), HasSubstr("'two' is one argument too many"));
  EXPECT_THAT(error({"wurst"}), testing::Not(HasSubstr("did you mean")));
}

// Each command's help has examples, and each is a command line that the program takes.
TEST(Usage, ExamplesAreOfCommandsAsTheyAre) {
  std::vector<std::string> commands;
  const std::string root = run({"--help"}).out;
  const auto listed = [](const std::string& help) {
    std::vector<std::string> out;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("  ") && line[2] != ' ') out.push_back(line.substr(2, line.find(' ', 2) - 2));
    return out;
  };
  for (const std::string& command : listed(root)) {
    const std::string help = run({command, "--help"}).out;
    if (help.find("Subcommands:") == std::string::npos) {
      commands.push_back(command);
    } else {
      for (const std::string& below : listed(help)) commands.push_back(command + " " + below);
    }
  }
  EXPECT_GT(commands.size(), 30U);
  for (const std::string& command : commands) {
    std::vector<std::string> words{"help"};
    std::istringstream names(command);
    for (std::string name; names >> name;) words.push_back(name);
    const std::string help = run(words).out;
    const std::size_t at = help.find("Example");
    if (at == std::string::npos) {
      ADD_FAILURE() << command << " has no example";
      continue;
    }
    std::istringstream lines(help.substr(at));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("  asperity ")) {
      EXPECT_TRUE(line.starts_with("  asperity " + command)) << line;
      std::vector<std::string> arguments;
      std::istringstream typed(line.substr(11));
      // As a shell takes it: what it would take for itself is in quotes.
      for (std::string word; typed >> word;) {
        const bool quoted = word.size() > 1 && word.front() == '"' && word.back() == '"';
        EXPECT_TRUE(quoted || word.find_first_of(";&|<>()$`\\\"'*?[]~#") == std::string::npos) << line;
        arguments.push_back(quoted ? word.substr(1, word.size() - 2) : word);
      }
      arguments.emplace_back("--print-config");
      EXPECT_EQ(run(arguments).code, 0) << line;
    }
  }
}

TEST(Usage, UnknownSettingNamesTheNearest) {
  const Outcome outcome = run({"roughness", "x", "--set", "roughness.section=4"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'roughness.section'"));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'roughness.sections'?"));
}

TEST(Usage, PrintedConfigReadsBack) {
  const testkit::TempDir dir;
  for (const auto& command : kCommands) {
    const Outcome printed = run({command, "--print-config"});
    ASSERT_EQ(printed.code, 0) << command << printed.err;
    write_text(dir / "settings.toml", printed.out);
    const Outcome again = run({command, "--print-config", "--config", (dir / "settings.toml").string()});
    EXPECT_EQ(again.code, 0) << command << again.err;
    EXPECT_EQ(again.out, printed.out) << command;
    const Outcome json = run({command, "--print-config", "--json"});
    EXPECT_TRUE(nlohmann::json::parse(json.out, nullptr, false).is_object()) << command;
  }
}

TEST(Usage, ConfigFileFaultsNameFileAndLine) {
  const testkit::TempDir dir;
  const std::string file = (dir / "settings.toml").string();
  const auto message = [&](const std::string& text) {
    write_text(file, text);
    const Outcome outcome = run({"roughness", "x", "--config", file});
    EXPECT_EQ(outcome.code, 1);
    return outcome.err;
  };
  EXPECT_THAT(message("[roughness]\n\nsectionz = 4\n"), HasSubstr(file + ":3: unknown setting 'roughness.sectionz'"));
  EXPECT_THAT(message("[roughness]\nsections = \"4\"\n"), HasSubstr(file + ":2: roughness.sections: "));
  EXPECT_THAT(message("[roughness]\nsections = 4.0\n"),
              HasSubstr(file + ":2: roughness.sections: '4.0' is not a whole number"));
  EXPECT_THAT(message("[roughness]\nsections = 1979-05-27\n"), HasSubstr(file + ":2: "));
  EXPECT_THAT(message("[roughness\n"), HasSubstr(file + ":1: "));
  EXPECT_THAT(message("roughness = 3\n"), HasSubstr(file + ":1: unknown setting 'roughness'"));
  EXPECT_THAT(message(std::string("\xff\xfe\x00", 3)), HasSubstr(file));
}

TEST(Usage, SettingsBeatTheFile) {
  const testkit::TempDir dir;
  const std::string file = (dir / "settings.toml").string();
  write_text(file, "[roughness]\nsections = 4\nform = \"line\"\n");
  const Outcome outcome = run({"roughness", "--print-config", "--config", file, "--set", "roughness.sections=7"});
  EXPECT_THAT(outcome.out, HasSubstr("sections = 7\n"));
  EXPECT_THAT(outcome.out, HasSubstr("form = \"line\"\n"));
}

TEST(Usage, ManualPageAndCompletionNameEveryCommandAndOption) {
  const Outcome manual = run({"--man"});
  const Outcome completion = run({"--completion", "bash"});
  EXPECT_EQ(manual.code, 0);
  EXPECT_EQ(completion.code, 0);
  EXPECT_THAT(manual.out, StartsWith(".TH ASPERITY 1"));
  for (const auto& command : kCommands) {
    std::string in_roff;
    for (const char letter : command) in_roff += letter == '-' ? std::string("\\-") : std::string(1, letter);
    EXPECT_THAT(manual.out, HasSubstr(".SS asperity " + in_roff));
    EXPECT_THAT(completion.out, HasSubstr("    " + command + ") words=\""));
  }
  for (const std::string command : {"texture fit", "markers ring", "calibrate camera", "calibrate latency"}) {
    EXPECT_THAT(manual.out, HasSubstr(".SS asperity " + command));
    EXPECT_THAT(completion.out, HasSubstr("    \"" + command + "\") words=\"--help"));
  }
  EXPECT_THAT(completion.out,
              HasSubstr("    calibrate) words=\"camera tracker force accel tip imu latency --help -h\""));
  EXPECT_THAT(completion.out, HasSubstr("--spacing"));
  EXPECT_THAT(completion.out, HasSubstr("    --method) values=\"fused thesis thesis_tuned raw ekf particle\" ;;"));
  EXPECT_THAT(completion.out, HasSubstr("complete -o filenames -F _asperity asperity"));
}

TEST(Usage, ManualPageHasADateAndExamples) {
  const Outcome manual = run({"--man"});
  EXPECT_THAT(manual.out, testing::ContainsRegex("^\\.TH ASPERITY 1 \"[0-9]{4}-[0-9]{2}-[0-9]{2}\""));
  EXPECT_THAT(manual.out, HasSubstr(".SH EXAMPLES\n"));
  EXPECT_THAT(manual.out, HasSubstr("asperity process rec \\-o out/rec"));
}

TEST(Usage, CompletionsForFishAndZshNameEveryCommand) {
  const Outcome fish = run({"--completion", "fish"});
  const Outcome zsh = run({"--completion", "zsh"});
  EXPECT_EQ(fish.code, 0);
  EXPECT_EQ(zsh.code, 0);
  EXPECT_THAT(zsh.out, StartsWith("#compdef asperity\n"));
  for (const auto& command : kCommands) {
    EXPECT_THAT(fish.out, HasSubstr("-n '__fish_use_subcommand' -a " + command + " -d "));
    EXPECT_THAT(zsh.out, HasSubstr("    " + command + ") choices=("));
  }
  EXPECT_THAT(
      fish.out,
      HasSubstr(
          "-n '__fish_seen_subcommand_from process' -l method -a 'fused thesis thesis_tuned raw ekf particle' -r -d "));
  EXPECT_THAT(zsh.out, HasSubstr("    'texture fit') choices=("));
  EXPECT_THAT(zsh.out, HasSubstr("    --method) values=(fused thesis thesis_tuned raw ekf particle) ;;"));
}

TEST(Usage, AFullDiskIsAnError) {
  const Outcome outcome = run_into("/dev/full", {"--help"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("standard output"));
}

}  // namespace
}  // namespace asperity::cli
