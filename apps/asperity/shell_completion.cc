#include "shell_completion.h"

#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity::app {

namespace {

std::string words(const Parser& app) {
  std::string out;
  for (const Option& option : app.options()) {
    for (const std::string& name : option.long_names()) out += (out.empty() ? "--" : " --") + name;
    for (const std::string& name : option.short_names()) out += (out.empty() ? "-" : " -") + name;
  }
  return out;
}

// "fit info …": what follows a command that has commands below it.
std::string names_below(const Parser& app) {
  std::string out;
  for (const Parser* below : app.subcommands()) out += below->name() + " ";
  return out;
}

// Options without dashes, and the words that may follow each.
using OptionValues = std::vector<std::pair<std::string, std::string>>;

OptionValues option_values() {
  OptionValues out;
  // "file" is none: a file's name is.
  const auto add = [&out](const char* option, const auto& names) {
    std::string values;
    for (const std::string_view name : names) {
      if (name != "file") values += (values.empty() ? "" : " ") + std::string(name);
    }
    out.emplace_back(option, values);
  };
  add("method", kMethodNames);
  add("probe", kProbeModelNames);
  add("surface", kSurfaceNames);
  add("completion", std::vector<std::string_view>{"bash", "fish", "zsh"});
  return out;
}

std::string bash_completion(const Parser& root) {
  std::string cases;
  std::string cases_below;
  for (const Parser* command : root.subcommands()) {
    const std::string names = names_below(*command);
    cases += "    " + command->name() + ") words=\"" + names + words(*command) + "\"" +
             (names.empty() ? "" : " names=2") + " ;;\n";
    for (const Parser* below : command->subcommands()) {
      cases_below += "    \"" + command->name() + " " + below->name() + "\") words=\"" + words(*below) + "\" ;;\n";
    }
  }
  std::string values;
  for (const auto& [option, names] : option_values()) values += "    --" + option + ") values=\"" + names + "\" ;;\n";
  return "# bash completion for asperity: source it, or put it in /etc/bash_completion.d/\n"
         "_asperity() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} names=1 words=\"" +
         names_below(root) + words(root) +
         "\"\n"
         "  [[ $COMP_CWORD -lt 2 ]] || case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  [[ $COMP_CWORD -lt 3 ]] || case \"${COMP_WORDS[1]} ${COMP_WORDS[2]}\" in\n" +
         cases_below +
         "  esac\n"
         "  local values=\n"
         "  case ${COMP_WORDS[COMP_CWORD-1]} in\n" +
         values +
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ $values && $current != -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$current\")\n"
         "    [[ ${#COMPREPLY[@]} -gt 0 ]] || mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  elif [[ $COMP_CWORD -le $names || $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _asperity asperity\n";
}

std::string zsh_completion(const Parser& root) {
  std::string cases;
  std::string cases_below;
  for (const Parser* command : root.subcommands()) {
    const std::string names = names_below(*command);
    cases += "    " + command->name() + ") choices=(" + names + words(*command) + ")" +
             (names.empty() ? "" : " named=3") + " ;;\n";
    for (const Parser* below : command->subcommands()) {
      cases_below += "    '" + command->name() + " " + below->name() + "') choices=(" + words(*below) + ") ;;\n";
    }
  }
  std::string values;
  for (const auto& [option, names] : option_values()) values += "    --" + option + ") values=(" + names + ") ;;\n";
  return "#compdef asperity\n"
         "# zsh completion for asperity: source it, or put it as _asperity into a folder of $fpath\n"
         "_asperity() {\n"
         "  local named=2\n"
         "  local -a choices values\n"
         "  choices=(" +
         names_below(root) + words(root) +
         ")\n"
         "  (( CURRENT < 3 )) || case ${words[2]} in\n" +
         cases +
         "  esac\n"
         "  (( CURRENT < 4 )) || case \"${words[2]} ${words[3]}\" in\n" +
         cases_below +
         "  esac\n"
         "  case ${words[CURRENT-1]} in\n" +
         values +
         "  esac\n"
         "  if (( ${#values} )) && [[ $PREFIX != -* ]]; then\n"
         "    compadd -a values || _files\n"
         "  elif (( CURRENT <= named )) || [[ $PREFIX == -* ]]; then\n"
         "    compadd -a choices\n"
         "  else\n"
         "    _files\n"
         "  fi\n"
         "}\n"
         "if [[ ${funcstack[1]} == _asperity ]]; then _asperity \"$@\"; else compdef _asperity asperity; fi\n";
}

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') out += '\\';
    out += letter;
  }
  return out + "'";
}

// The options of one command, offered where `condition` holds.
std::string fish_options(const Parser& app, const std::string& condition, const OptionValues& values) {
  std::string out;
  for (const Option& option : app.options()) {
    if (option.is_positional()) continue;
    out += "complete -c asperity -n " + fish_quoted(condition);
    for (const std::string& name : option.short_names()) out += " -s " + name;
    for (const std::string& name : option.long_names()) {
      out += " -l " + name;
      for (const auto& [known, names] : values) {
        if (known == name) out += " -a " + fish_quoted(names);
      }
    }
    out += (option.takes_value() ? " -r -d " : " -d ") + fish_quoted(option.description()) + "\n";
  }
  return out;
}

std::string fish_command(const Parser& app, const std::string& condition) {
  return "complete -c asperity -f -n " + fish_quoted(condition) + " -a " + app.name() + " -d " +
         fish_quoted(app.description()) + "\n";
}

std::string fish_completion(const Parser& root) {
  const OptionValues values = option_values();
  std::string out =
      "# fish completion for asperity: source it, or put it into ~/.config/fish/completions/asperity.fish\n";
  out += fish_options(root, "__fish_use_subcommand", values);
  for (const Parser* command : root.subcommands()) {
    const std::string seen = "__fish_seen_subcommand_from " + command->name();
    const std::string names = names_below(*command);
    const std::string itself = names.empty() ? seen : seen + "; and not __fish_seen_subcommand_from " + names;
    out += fish_command(*command, "__fish_use_subcommand") + fish_options(*command, itself, values);
    for (const Parser* below : command->subcommands()) {
      out += fish_command(*below, itself);
      out += fish_options(*below, seen + "; and __fish_seen_subcommand_from " + below->name(), values);
    }
  }
  return out;
}

}  // namespace

std::string shell_completion(const std::string& shell, const Parser& root) {
  if (shell == "bash") return bash_completion(root);
  if (shell == "fish") return fish_completion(root);
  if (shell == "zsh") return zsh_completion(root);
  throw Error("completion: '" + shell + "' is not bash, fish or zsh");
}

}  // namespace asperity::app
