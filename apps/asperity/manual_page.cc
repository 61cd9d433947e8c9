#include "manual_page.h"

#include <array>
#include <string_view>
#include <utility>

#include "asperity/base/version.h"

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

std::string command_section(const Parser& command, const std::string& name) {
  std::string out = ".SS asperity " + roff(name) + "\n" + roff(command.description()) + "\n" + option_list(command);
  for (const Parser* below : command.subcommands()) {
    out += command_section(*below, name + " " + below->name());
  }
  return out;
}

// What a reader does first, with what each line is for.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kExamples{{
    {"asperity demo -o out",
     "A recording of a simulated probe, processed and compared with the truth; a report to open."},
    {"asperity record --probe serial:/dev/ttyUSB0 --camera v4l2:/dev/video0 --markers markers.json "
     "--calibration calibration.json -o rec",
     "Record a scan with a probe and a camera."},
    {"asperity process rec -o out/rec", "From a recording to its profile, roughness and texture."},
    {"asperity process --print-config", "Every setting, its default and its meaning."},
    {"asperity register rec object.obj --mesh-unit mm -o out/object",
     "Find where the scan is on a mesh, and texture it."},
    {"asperity feel out/object", "Render the scene with a simulated hand; --device selects a haptic device."},
    {"asperity studio FOLDER", "All of this in a browser."},
}};

std::string examples() {
  std::string out;
  for (const auto& [line, purpose] : kExamples) {
    out += ".TP\n\\fB" + roff(std::string(line)) + "\\fR\n" + roff(std::string(purpose)) + "\n";
  }
  return out;
}

}  // namespace

std::string manual_page(const Parser& root) {
  std::string out =
      ".TH ASPERITY 1 \"" + std::string(kVersionDate) + "\" \"asperity " + kVersion + "\" \"User Commands\"\n";
  out += ".SH NAME\nasperity \\- " + roff(root.description()) + "\n";
  out += ".SH SYNOPSIS\n.B asperity\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH OPTIONS\n" + option_list(root);
  out += ".SH COMMANDS\n";
  for (const Parser* command : root.subcommands()) out += command_section(*command, command->name());
  out += ".SH EXAMPLES\n" + examples();
  out +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe input is bad; standard error states where\n.TP\n2\nthe command line "
      "is wrong\n";
  out +=
      ".TP\n3\ndone, but the result is invalid; standard error states why\n.TP\n128 + signal\nstopped by a signal, 130 "
      "for Ctrl\\-C; standard error names the files that were written\n";
  return out;
}

}  // namespace asperity::app
