#include "command.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "asperity/base/text.h"
#include "config_file.h"
#include "terminal_text.h"

namespace asperity::app {

Command::Command(Parser& root, const std::string& name, const std::string& description)
    : parser_(&root.add_subcommand(name, description)) {
  parser_->add_flag("--json", json_, "Print one JSON object on standard output");
  parser_->add_option("--config", config_file_, "Read settings from a TOML file")->type_name("FILE.toml");
  parser_->add_option("--set", settings_, "Change one setting; may be repeated")
      ->type_name("STAGE.FIELD=VALUE")
      ->one_value_each();
  parser_->add_flag("--print-config", print_config_, "Print all settings with their meaning, and stop");
  parser_->add_flag("--quiet", quiet_, "Print no progress and no summary");
}

Option* Command::require(Option* option) {
  required_.push_back(option);
  return option->describe(option->description() + " (required)");
}

bool Command::resolve() {
  if (!print_config_) {
    for (const Option* option : required_) {
      if (option->count() == 0) throw UsageError(option->name() + " is missing");
    }
  }
  const std::vector<ConfigField> all = fields();
  if (!config_file_.empty()) load_config_file(config_file_, all);
  apply_options();
  for (const std::string& setting : settings_) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos) {
      throw UsageError("--set needs STAGE.FIELD=VALUE, not '" + printable(setting) + "'");
    }
    try {
      set_field(all, trim(std::string_view(setting).substr(0, equals)), std::string_view(setting).substr(equals + 1));
    } catch (const Error& error) {
      throw UsageError("--set: " + setting_fault(error));
    }
  }
  if (print_config_) print_text(json_ ? fields_to_json(all) + "\n" : to_toml(all, true));
  return !print_config_;
}

std::string Command::with_input(const std::string& message) const {
  for (const std::filesystem::path path : {read_from_, read_over_}) {
    const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
    if (name.empty()) {
      if (read_from_.empty()) return message;
      continue;
    }
    // As a file is named: at the end of a path, before a colon, or in quotes.
    for (const std::string& named : {"/" + name, name + ":", "'" + name + "'"}) {
      if (message.find(printable(named, 200)) != std::string::npos) return message;
    }
  }
  const std::string over = read_over_.empty() ? "" : " over " + printable(read_over_, 200);
  return printable(read_from_, 200) + over + ": " + message;
}

void Command::say(std::string_view text) const {
  if (!json_ && !quiet_) print_text(terminal_text(text));
}

void Command::print_json(std::string_view object) const {
  if (!json_) return;
  print_text(terminal_json(object));
  if (!object.ends_with('\n')) print_text("\n");
}

void print_text(std::string_view text) {
  // It lives until the caller's whole expression ends.
  // cppcheck-suppress danglingTemporaryLifetime
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    if (errno == EPIPE) throw ClosedPipe();
    throw Error(std::string("standard output cannot be written: ") + std::strerror(errno));
  }
}

void print_error(std::string_view text) {
  // Paths and names in it may be a stranger's: nothing in them reaches the terminal as a command.
  std::string lines = "asperity: ";
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines += printable(text.substr(from, to - from), std::string_view::npos) + '\n';
    from = to + 1;
  }
  std::fwrite(lines.data(), 1, lines.size(), stderr);
}

void commit_output(OutputFolder& folder, std::string_view output) {
  for (const std::filesystem::path& name : folder.commit()) {
    print_error(printable(output, 200) + ": " + printable(name.string(), 200) +
                " was added during the run; it was kept");
  }
}

void name_kept(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& kept) {
  for (const std::filesystem::path& name : kept) {
    print_error(printable(folder.string(), 200) + ": " + printable(name.string(), 200) +
                " is not a file of asperity; it was kept");
  }
}

}  // namespace asperity::app
