#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/progress.h"
#include "parser.h"

namespace asperity::app {

inline constexpr int kDone = 0;
inline constexpr int kBadInput = 1;
inline constexpr int kUsage = 2;
inline constexpr int kNotTrustworthy = 3;  // done, but the result is invalid

// A command line that cannot be meant as it stands; ends the program with kUsage.
class UsageError : public Error {
 public:
  using Error::Error;
};

// The reader of standard output is gone, as after `| head`: nobody is left to be told.
class ClosedPipe : public Error {
 public:
  ClosedPipe() : Error("standard output was closed") {}
};
inline constexpr int kClosedPipe = 141;  // 128 + SIGPIPE, as a shell reports it

// One subcommand: its options are bound in the constructor, its settings listed by fields().
class Command {
 public:
  Command(Parser& root, const std::string& name, const std::string& description);
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  // The settings that --config, --set and --print-config reach.
  virtual std::vector<ConfigField> fields() { return {}; }
  // Options that stand for settings, applied between --config and --set.
  virtual void apply_options() {}
  // Returns the exit code.
  virtual int run(const Observer& observer) = 0;

  Parser& parser() { return *parser_; }
  // `message` with what was being read before it, unless it names that already.
  std::string with_input(const std::string& message) const;
  // Brings the settings to what the command line says; true if the command is then to be run,
  // false if --print-config has printed them. Throws UsageError for a missing required option.
  bool resolve();
  bool quiet() const { return quiet_; }

 protected:
  // Required unless --print-config is given.
  Option* require(Option* option);
  bool json() const { return json_; }
  // From now on an error is one of this file or folder: for what is found out behind the reader, which knows no names.
  // `mesh` is the file of the mesh that it is over.
  void reads(std::string path, std::string mesh = {}) {
    read_from_ = std::move(path);
    read_over_ = std::move(mesh);
  }
  // For a person: prints unless --json or --quiet.
  void say(std::string_view text) const;
  // The result: prints `object` if --json. One line break is added.
  void print_json(std::string_view object) const;

 private:
  Parser* parser_;
  std::vector<Option*> required_;
  std::string read_from_, read_over_;
  bool json_ = false;
  bool quiet_ = false;
  bool print_config_ = false;
  std::string config_file_;
  std::vector<std::string> settings_;
};

// Writes to standard output. Throws ClosedPipe, or Error if it takes no more (a full disk).
void print_text(std::string_view text);
// One line on standard error, "asperity: text".
void print_error(std::string_view text);

// Puts the folder in its target's place, and names on standard error what others put there meanwhile and was kept.
void commit_output(OutputFolder& folder, std::string_view output);
// The same for files in `folder` that are not of asperity and were kept.
void name_kept(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& kept);

}  // namespace asperity::app
