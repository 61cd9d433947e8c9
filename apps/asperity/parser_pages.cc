#include "parser_pages.h"

#include <string_view>
#include <vector>

#include "asperity/base/version.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity::app {

namespace {

// roff takes a leading dot or quote as a request, and a bare hyphen as a hyphenation point.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool line_start = i == 0 || text[i - 1] == '\n';
    if (line_start && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\') {
      out += "\\e";
    } else if (text[i] == '-') {
      out += "\\-";
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string option_heading(const Option& option) {
  if (option.is_positional()) return "\\fI" + roff(option.names()) + "\\fR";
  std::string out = "\\fB" + roff(option.names()) + "\\fR";
  if (option.takes_value()) out += " \\fI" + roff(option.value_name()) + "\\fR";
  return out;
}

std::string option_list(const Parser& app) {
  std::string out;
  for (const Option& option : app.options()) {
    out += ".TP\n" + option_heading(option) + "\n" + roff(option.description()) + "\n";
  }
  return out;
}

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

std::string command_section(const Parser& command, const std::string& name) {
  std::string out = ".SS asperity " + roff(name) + "\n" + roff(command.description()) + "\n" + option_list(command);
  for (const Parser* below : command.subcommands()) {
    out += command_section(*below, name + " " + below->name());
  }
  return out;
}

// One case of the completion: the words that may follow `option`. "file" is none: a file's name is.
template <class Names>
std::string value_case(const std::string& option, const Names& names) {
  std::string out;
  for (const std::string_view name : names) {
    if (name != "file") out += (out.empty() ? "" : " ") + std::string(name);
  }
  return "    " + option + ") values=\"" + out + "\" ;;\n";
}

}  // namespace

std::string manual_page(const Parser& root) {
  std::string out = ".TH ASPERITY 1 \"\" \"asperity " + std::string(kVersion) + "\" \"User Commands\"\n";
  out += ".SH NAME\nasperity \\- " + roff(root.description()) + "\n";
  out += ".SH SYNOPSIS\n.B asperity\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH OPTIONS\n" + option_list(root);
  out += ".SH COMMANDS\n";
  for (const Parser* command : root.subcommands()) out += command_section(*command, command->name());
  out +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe input is bad; standard error says where\n.TP\n2\nthe command line is "
      "wrong\n";
  out +=
      ".TP\n3\ndone, but the result is not to be trusted; standard error says why\n.TP\n128 + signal\nstopped by a "
      "signal, 130 for Ctrl\\-C; nothing was written\n";
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
  const std::string values = value_case("--method", kMethodNames) + value_case("--probe", kProbeModelNames) +
                             value_case("--surface", kSurfaceNames) +
                             value_case("--completion", std::vector<std::string_view>{"bash"});
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

}  // namespace asperity::app
