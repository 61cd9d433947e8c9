#include "parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "asperity/base/nearest_word.h"
#include "asperity/base/text.h"

namespace asperity::app {

Option* Option::type_name(const std::string& name) { return option_->type_name(name), this; }
Option* Option::one_of(std::initializer_list<const char*> values) {
  choices_.assign(values.begin(), values.end());
  return option_->check(CLI::IsMember(choices_)), this;
}
Option* Option::in_range(int low, int high) { return option_->check(CLI::Range(low, high)), this; }
Option* Option::excludes(Option* other) { return option_->excludes(other->option_), this; }
Option* Option::show_default() { return option_->capture_default_str(), this; }
Option* Option::one_value_each() { return option_->allow_extra_args(false), this; }
Option* Option::describe(const std::string& description) { return option_->description(description), this; }

std::size_t Option::count() const { return option_->count(); }
bool Option::is_positional() const { return option_->get_positional(); }
bool Option::takes_value() const { return option_->get_items_expected_max() > 0; }
std::string Option::name() const { return option_->get_name(option_->get_positional()); }
std::string Option::names() const { return is_positional() ? option_->get_name(true) : option_->get_name(false, true); }
std::string Option::value_name() const { return option_->get_type_name(); }
std::string Option::description() const { return option_->get_description(); }
std::vector<std::string> Option::long_names() const { return option_->get_lnames(); }
std::vector<std::string> Option::short_names() const { return option_->get_snames(); }

Parser::Parser(const std::string& name, const std::string& description)
    : owned_(std::make_unique<CLI::App>(description)), app_(owned_.get()) {
  app_->name(name);
}
Parser::Parser(CLI::App& app, const Parser* parent) : app_(&app), parent_(parent) {}
Parser::~Parser() = default;

Parser& Parser::add_subcommand(const std::string& name, const std::string& description) {
  subcommands_.push_back(std::unique_ptr<Parser>(new Parser(*app_->add_subcommand(name, description), this)));
  return *subcommands_.back();
}

void Parser::require_subcommand(int least, int most) {
  app_->require_subcommand(static_cast<std::size_t>(least), static_cast<std::size_t>(most));
}

void Parser::set_examples(const std::vector<std::string>& lines) {
  std::string text = lines.size() == 1 ? "Example:" : "Examples:";
  for (const std::string& line : lines) text += "\n  " + line;
  app_->footer(text);
}

void Parser::set_version_flag(const std::string& name, const std::string& version) {
  app_->set_version_flag(name, version);
}

Option* Parser::keep(CLI::Option* option) { return &options_.emplace_back(*option); }

Option* Parser::add_option(const std::string& names, std::string& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, double& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, std::optional<double>& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, int& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, std::int64_t& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, std::uint64_t& value, const std::string& description) {
  return keep(app_->add_option(names, value, description));
}
Option* Parser::add_option(const std::string& names, std::vector<std::string>& values, const std::string& description) {
  return keep(app_->add_option(names, values, description));
}
Option* Parser::add_flag(const std::string& names, bool& value, const std::string& description) {
  return keep(app_->add_flag(names, value, description));
}

ParsedLine Parser::parse(int argc, char** argv) {
  const auto chosen = [this] {
    const Parser& parser = chosen_parser();
    return &parser == this ? std::string() : parser.full_name();
  };
  try {
    app_->parse(argc, argv);
    return {ParsedLine::Kind::kCommand, "", chosen()};
  } catch (const CLI::CallForHelp&) {
    return {ParsedLine::Kind::kText, app_->help(), chosen()};
  } catch (const CLI::CallForVersion& version) {
    return {ParsedLine::Kind::kText, std::string(version.what()) + "\n", chosen()};
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> left = app_->remaining(true);
    const bool is_left_over = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                              dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (left.empty() || !is_left_over) return {ParsedLine::Kind::kFault, printable(error.what(), 300), chosen()};
    const Parser& parser = with_left_over();
    return {ParsedLine::Kind::kFault, parser.unknown_word(left.front()), &parser == this ? "" : parser.full_name()};
  }
}

const Parser& Parser::chosen_parser() const {
  for (const auto& below : subcommands_)
    if (below->is_parsed()) return below->chosen_parser();
  return *this;
}

const Parser& Parser::with_left_over() const {
  if (!app_->remaining(false).empty()) return *this;
  for (const auto& below : subcommands_)
    if (below->is_parsed()) return below->with_left_over();
  return *this;
}

std::string Parser::unknown_word(const std::string& word) const {
  std::vector<std::string> known;
  const bool is_option = word.starts_with('-');
  if (is_option) {
    for (const Option& option : options())
      for (const std::string& name : option.long_names()) known.push_back("--" + name);
  } else {
    for (const auto& below : subcommands_) known.push_back(below->name());
    if (!parent_) known.emplace_back("help");
  }
  const std::string typed = word.substr(0, word.find('='));
  std::string out = "'" + printable(typed, 60) + "' is ";
  out += is_option ? "not an option" : !known.empty() ? "not a command" : "one argument too many";
  const std::string nearest = nearest_word(typed, known);
  return nearest.empty() ? out : out + "; did you mean " + nearest + "?";
}

bool Parser::is_parsed() const { return app_->parsed(); }
std::size_t Parser::count(const std::string& name) const { return app_->count(name); }
std::string Parser::name() const { return app_->get_name(); }
std::string Parser::full_name() const {
  return parent_ && parent_->parent_ ? parent_->full_name() + " " + name() : name();
}
std::string Parser::description() const { return app_->get_description(); }

const Parser* Parser::find(const std::string& name) const {
  for (const auto& below : subcommands_)
    if (below->name() == name) return below.get();
  return nullptr;
}

std::vector<const Parser*> Parser::subcommands() const {
  std::vector<const Parser*> out;
  for (const auto& below : subcommands_) out.push_back(below.get());
  return out;
}

std::vector<Option> Parser::options() const {
  std::vector<Option> out;
  for (CLI::Option* option : app_->get_options()) {
    const auto kept =
        std::find_if(options_.begin(), options_.end(), [&](const Option& one) { return one.option_ == option; });
    out.push_back(kept == options_.end() ? Option(*option) : *kept);  // --help is of CLI11 itself
  }
  return out;
}

}  // namespace asperity::app
