#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's
class App;
class Option;
}  // namespace CLI

namespace asperity::app {

// The command line's words. CLI11 does the parsing, in parser.cc alone: its header is 80,000 lines.

// One option, flag or positional argument. Each setter returns the option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option* type_name(const std::string& name);  // of its value, as the help prints it
  // The parser refuses all other values.
  Option* one_of(std::initializer_list<const char*> values);
  // Values that a shell completes, of an option that the command checks: all that it takes, or those beside which there
  // are files, lengths or addresses. One that ends in a colon is the beginning of a value.
  template <class Names>
  Option* suggest(const Names& values) {
    for (const auto& value : values) choices_.emplace_back(value);
    return this;
  }
  Option* in_range(int low, int high);
  Option* excludes(Option* other);
  Option* show_default();
  Option* one_value_each();  // may be repeated, with one value each time
  Option* describe(const std::string& description);

  std::size_t count() const;  // how often it is on the command line
  bool is_positional() const;
  bool takes_value() const;
  std::string name() const;   // as an error names it
  std::string names() const;  // "-o,--output", or a positional's name
  std::string value_name() const;
  std::string description() const;
  const std::vector<std::string>& choices() const { return choices_; }  // of one_of() or suggest(); empty: any value
  std::vector<std::string> long_names() const;                          // without dashes
  std::vector<std::string> short_names() const;                         // without a dash

 private:
  friend class Parser;
  CLI::Option* option_;
  std::vector<std::string> choices_;
};

// What a command line came to.
struct ParsedLine {
  enum class Kind { kCommand, kText, kFault };
  Kind kind = Kind::kCommand;
  std::string text;     // help or version to print, or what is wrong
  std::string command;  // the one that was chosen, as it is typed; "" for none
};

// The program's options, or those of one of its commands.
class Parser {
 public:
  Parser(const std::string& name, const std::string& description);
  ~Parser();
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  Parser& add_subcommand(const std::string& name, const std::string& description);
  // `most` = 0: any number.
  void require_subcommand(int least, int most);
  // Printed below its options.
  void set_examples(const std::vector<std::string>& lines);
  void set_version_flag(const std::string& name, const std::string& version);

  // `names` such as "-o,--output", or "FILE" for a positional argument. The value keeps what it has if the option is
  // not given.
  Option* add_option(const std::string& names, std::string& value, const std::string& description);
  Option* add_option(const std::string& names, double& value, const std::string& description);
  Option* add_option(const std::string& names, std::optional<double>& value, const std::string& description);
  Option* add_option(const std::string& names, int& value, const std::string& description);
  Option* add_option(const std::string& names, std::int64_t& value, const std::string& description);
  Option* add_option(const std::string& names, std::uint64_t& value, const std::string& description);
  Option* add_option(const std::string& names, std::vector<std::string>& values, const std::string& description);
  Option* add_flag(const std::string& names, bool& value, const std::string& description);

  ParsedLine parse(int argc, char** argv);
  bool is_parsed() const;                            // this command is on the command line
  std::size_t count(const std::string& name) const;  // how often the option is there

  // The fault of a word that is not an option or a command of this one, with the nearest one.
  std::string unknown_word(const std::string& word) const;
  // The command below this one, or nullptr.
  const Parser* find(const std::string& name) const;

  std::string name() const;
  std::string full_name() const;  // "process", "texture fit": as it is typed
  std::string description() const;
  std::vector<const Parser*> subcommands() const;
  std::vector<Option> options() const;

 private:
  Parser(CLI::App& app, const Parser* parent);
  Option* keep(CLI::Option* option);
  const Parser& chosen_parser() const;   // the command that is on the command line, or the program
  const Parser& with_left_over() const;  // the first on the line that was given a word too many

  std::unique_ptr<CLI::App> owned_;
  CLI::App* app_;
  const Parser* parent_ = nullptr;
  std::deque<Option> options_;
  std::vector<std::unique_ptr<Parser>> subcommands_;
};

}  // namespace asperity::app
