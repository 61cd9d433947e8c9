#include "shell_completion.h"

#include <string_view>
#include <vector>

#include "asperity/base/error.h"

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

std::string joined(const std::vector<std::string>& values) {
  std::string out;
  for (const std::string& value : values) out += (out.empty() ? "" : " ") + value;
  return out;
}

// One line of a `case` over "COMMAND OPTION", the option as it is typed, or "COMMAND" for a positional argument, for
// each with choices, of the command and of those below it.
std::string choice_cases(const Parser& app, const std::string& command, bool positional, const CaseSyntax& syntax) {
  std::string out;
  for (const Option& option : app.options()) {
    if (option.choices().empty() || option.is_positional() != positional) continue;
    std::string pattern;
    if (positional) {
      pattern = "\"" + command + "\"";
    } else {
      for (const std::string& name : option.long_names()) {
        pattern += (pattern.empty() ? "\"" : " | \"") + command + " --" + name + "\"";
      }
      for (const std::string& name : option.short_names()) {
        pattern += (pattern.empty() ? "\"" : " | \"") + command + " -" + name + "\"";
      }
    }
    out += syntax.line(pattern, joined(option.choices()));
  }
  for (const Parser* below : app.subcommands()) {
    out += choice_cases(*below, command.empty() ? below->name() : command + " " + below->name(), positional, syntax);
  }
  return out;
}

// "texture | markers": the commands that have commands below them.
std::string groups(const Parser& root) {
  std::string out;
  for (const Parser* command : root.subcommands()) {
    if (!command->subcommands().empty()) out += (out.empty() ? "" : " | ") + command->name();
  }
  return out.empty() ? "''" : out;
}

std::string bash_completion(const Parser& root, const std::vector<CommandSettings>& settings) {
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
  const CaseSyntax syntax{"values", "\"", "\""};
  // A word ends at = and at : (COMP_WORDBREAKS), so that --probe=open is three, and --set=a.b=c five.
  return "# bash completion for asperity: source it, or put it in /etc/bash_completion.d/\n"
         "_asperity() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} at=$((COMP_CWORD-1)) option before= setting= names=1 words=\"" +
         names_below(root) + words(root) +
         "\"\n"
         "  if [[ $current == [=:] ]]; then\n"
         "    current=\n"
         "  elif [[ ${COMP_WORDS[at]} == = && $at -gt 0 ]]; then\n"
         "    at=$((at-1))\n"
         "  fi\n"
         "  option=${COMP_WORDS[at]}\n"
         "  if [[ $current == --*=* ]]; then\n"
         "    option=${current%%=*} before=${current%%=*}= current=${current#*=}\n"
         "  fi\n"
         "  if [[ $option == --set && $current == *=* ]]; then\n"
         "    setting=${current%%=*} before+=${current%%=*}= current=${current#*=}\n"
         "  elif [[ $at -gt 1 && ${COMP_WORDS[at+1]} == = && ${COMP_WORDS[at-1]} == --set ||\n"
         "          $at -gt 2 && ${COMP_WORDS[at+1]} == = && ${COMP_WORDS[at-1]} == = && ${COMP_WORDS[at-2]} == --set "
         "]]; then\n"
         "    setting=$option\n"
         "  fi\n"
         "  [[ $COMP_CWORD -lt 2 ]] || case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  [[ $COMP_CWORD -lt 3 ]] || case \"${COMP_WORDS[1]} ${COMP_WORDS[2]}\" in\n" +
         cases_below +
         "  esac\n"
         "  local command=${COMP_WORDS[1]} values=\n"
         "  case $command in\n"
         "    -*) command= ;;\n"
         "    " +
         groups(root) +
         ") command+=\" ${COMP_WORDS[2]}\" ;;\n"
         "  esac\n"
         "  [[ ! $setting ]] || option=$setting\n"
         "  case \"$command $option\" in\n" +
         choice_cases(root, "", false, syntax) + setting_key_cases(settings, syntax) +
         "  esac\n"
         "  [[ ! $setting ]] || case \"$command $setting\" in\n" +
         setting_value_cases(settings, syntax) +
         "  esac\n"
         "  [[ $values || $setting || $COMP_CWORD -le $names || $option == -* ]] || case $command in\n" +
         choice_cases(root, "", true, syntax) +
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ $values && $current != -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$current\")\n"
         "    if [[ ${#COMPREPLY[@]} -eq 0 ]]; then\n"
         "      mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "    else\n"
         "      compopt +o filenames 2>/dev/null\n"  // which would put a backslash before a colon
         "      [[ ${#COMPREPLY[@]} -ne 1 || ${COMPREPLY[0]} != *[=:] ]] || compopt -o nospace 2>/dev/null\n"
         "    fi\n"
         "  elif [[ ! $before && ( $COMP_CWORD -le $names || $current == -* ) ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  fi\n"
         "  COMPREPLY=(\"${COMPREPLY[@]/#/$before}\")\n"
         "}\n"
         "complete -o filenames -F _asperity asperity\n";
}

std::string zsh_completion(const Parser& root, const std::vector<CommandSettings>& settings) {
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
  const CaseSyntax syntax{"values", "(", ")"};
  return "#compdef asperity\n"
         "# zsh completion for asperity: source it, or put it as _asperity into a folder of $fpath\n"
         "_asperity() {\n"
         "  local named=2 command=${words[2]} option=${words[CURRENT-1]} setting=\n"
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
         "  case $command in\n"
         "    -*) command= ;;\n"
         "    " +
         groups(root) +
         ") command+=\" ${words[3]}\" ;;\n"
         "  esac\n"
         "  if [[ $PREFIX == --*=* ]]; then\n"
         "    option=${PREFIX%%=*} named=0\n"
         "    compset -P \"$option=\"\n"
         "  fi\n"
         "  if [[ $option == --set && $PREFIX == *=* ]]; then\n"
         "    setting=${PREFIX%%=*}\n"
         "    compset -P \"$setting=\"\n"
         "    case \"$command $setting\" in\n" +
         setting_value_cases(settings, syntax) +
         "    esac\n"
         "  else case \"$command $option\" in\n" +
         choice_cases(root, "", false, syntax) + setting_key_cases(settings, syntax) +
         "    esac\n"
         "  fi\n"
         "  (( ${#values} || CURRENT <= named )) || [[ $option == -* ]] || case $command in\n" +
         choice_cases(root, "", true, syntax) +
         "  esac\n"
         "  if (( ${#values} )) && [[ $PREFIX != -* ]]; then\n"
         "    local found=1\n"
         "    compadd -S '' -- ${(M)values:#*[:=]} && found=0\n"
         "    compadd -- ${values:#*[:=]} && found=0\n"
         "    (( ! found )) || { compset -P '*:'; _files }\n"
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

// Keys, and behind a key's = its values: fish completes KEY=VALUE as one word.
std::string fish_settings(const std::string& command, const std::vector<CommandSettings>& settings) {
  for (const CommandSettings& each : settings) {
    if (each.command != command || each.fields.empty()) continue;
    std::string words = setting_keys(each);
    for (const ConfigField& field : each.fields) {
      for (const std::string& value : values_of(field)) words += " " + field.path + "=" + value;
    }
    return " -a '(__asperity_settings " + words + ")'";
  }
  return "";
}

// The options of one command, offered where `condition` holds.
std::string fish_options(const Parser& app, const std::string& condition,
                         const std::vector<CommandSettings>& settings) {
  std::string out;
  for (const Option& option : app.options()) {
    const std::string choices = option.choices().empty() ? "" : " -a " + fish_quoted(joined(option.choices()));
    if (option.is_positional()) {
      if (!choices.empty()) out += "complete -c asperity -n " + fish_quoted(condition) + choices + "\n";
      continue;
    }
    out += "complete -c asperity -n " + fish_quoted(condition);
    for (const std::string& name : option.short_names()) out += " -s " + name;
    for (const std::string& name : option.long_names()) out += " -l " + name;
    if (option.names() == "--set") out += fish_settings(app.full_name(), settings);
    out += choices + (option.takes_value() ? " -r -d " : " -d ") + fish_quoted(option.description()) + "\n";
  }
  return out;
}

std::string fish_command(const Parser& app, const std::string& condition) {
  return "complete -c asperity -f -n " + fish_quoted(condition) + " -a " + app.name() + " -d " +
         fish_quoted(app.description()) + "\n";
}

std::string fish_completion(const Parser& root, const std::vector<CommandSettings>& settings) {
  std::string out =
      "# fish completion for asperity: source it, or put it into ~/.config/fish/completions/asperity.fish\n"
      "function __asperity_settings\n"
      "  if string match -q '*=*' -- (commandline -ct | string replace -r -- '^--set=' '')\n"
      "    string match -- '*=?*' $argv\n"
      "  else\n"
      "    string match -- '*=' $argv\n"
      "  end\n"
      "end\n";
  out += fish_options(root, "__fish_use_subcommand", settings);
  for (const Parser* command : root.subcommands()) {
    const std::string seen = "__fish_seen_subcommand_from " + command->name();
    const std::string names = names_below(*command);
    const std::string itself = names.empty() ? seen : seen + "; and not __fish_seen_subcommand_from " + names;
    out += fish_command(*command, "__fish_use_subcommand") + fish_options(*command, itself, settings);
    for (const Parser* below : command->subcommands()) {
      out += fish_command(*below, itself);
      out += fish_options(*below, seen + "; and __fish_seen_subcommand_from " + below->name(), settings);
    }
  }
  return out;
}

}  // namespace

std::string shell_completion(const std::string& shell, const Parser& root,
                             const std::vector<CommandSettings>& settings) {
  if (shell == "bash") return bash_completion(root, settings);
  if (shell == "fish") return fish_completion(root, settings);
  if (shell == "zsh") return zsh_completion(root, settings);
  throw Error("completion: '" + shell + "' is not bash, fish or zsh");
}

}  // namespace asperity::app
