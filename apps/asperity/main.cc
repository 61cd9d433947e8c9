#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/import/stated_setting.h"
#include "asperity/session/interrupt.h"
#include "command.h"
#include "command_examples.h"
#include "commands.h"
#include "explain_code.h"
#include "manual_page.h"
#include "progress_line.h"
#include "shell_completion.h"

namespace asperity::app {

namespace {

struct Program {
  Parser parser{"asperity", "measures the fine surface of real objects and renders it to the hand"};
  bool manual = false;
  std::string completion;
  std::vector<std::unique_ptr<Command>> commands;

  Program() {
    parser.set_version_flag("--version", std::string("asperity ") + kVersion);
    parser.add_flag("--man", manual, "Print the manual page");
    parser.add_option("--completion", completion, "Print completions for a shell")->one_of({"bash", "fish", "zsh"});
    parser.require_subcommand(0, 1);
    for (const auto make : {make_demo,      make_simulate, make_export,       make_feel,     make_import,  make_inspect,
                            make_merge,     make_paint,    make_plot,         make_process,  make_realism, make_record,
                            make_recover,   make_register, make_area_command, make_report,   make_batch,   make_bench,
                            make_roughness, make_studio,   make_track,        make_check_rig}) {
      commands.push_back(make(parser));
    }
    Parser& texture = parser.add_subcommand("texture", "Fit, describe, synthesize, swap and compare textures");
    texture.require_subcommand(1, 0);
    for (const auto make :
         {make_texture_fit, make_texture_info, make_texture_synthesize, make_texture_swap, make_texture_compare}) {
      commands.push_back(make(texture));
    }
    Parser& study =
        parser.add_subcommand("study", "Plan and run a study, and evaluate the answers of its participants");
    study.require_subcommand(1, 0);
    commands.push_back(make_study_plan(study));
    commands.push_back(make_study_run(study));
    commands.push_back(make_study_summarize(study));
    commands.push_back(make_study_table(study));
    Parser& markers = parser.add_subcommand("markers", "Print tags and boards at true scale, and find them in images");
    markers.require_subcommand(1, 0);
    for (const auto make :
         {make_markers_sheet, make_markers_ring, make_markers_board, make_markers_charuco, make_markers_detect}) {
      commands.push_back(make(markers));
    }
    Parser& calibrate =
        parser.add_subcommand("calibrate", "Find the values of a calibration, their standard errors and a verdict");
    calibrate.require_subcommand(1, 0);
    for (const auto make : {make_calibrate_camera, make_calibrate_tracker, make_calibrate_force, make_calibrate_accel,
                            make_calibrate_tip, make_calibrate_imu, make_calibrate_latency}) {
      commands.push_back(make(calibrate));
    }
    for (const auto& command : commands)
      command->parser().set_examples(command_examples(command->parser().full_name()));
  }
};

int usage(const std::string& message, const std::string& command) {
  print_error(message);
  print_error("see asperity " + (command.empty() ? "" : command + " ") + "--help");
  return kUsage;
}

// What went wrong, and what stands all the same.
void tell_failure(const std::string& what) {
  const std::string kept = outputs_in_place();
  const bool named = kept.empty() || what.find("is written") != std::string::npos;
  print_error(what + (named ? "" : "; what was written before stays: " + kept));
}

std::string mesh_unit_hint(const UnlikelyMetres& error) {
  if (error.size_m() < 1.0) return ": --mesh-unit LENGTH, or --mesh-unit m if that is right";
  return fmt::format(": --mesh-unit mm makes it {:.3g} mm, --mesh-unit m if a metre is right", error.size_m());
}

int run_command(Command& command) {
  const std::string name = command.parser().full_name();
  try {
    if (!command.resolve()) return kDone;
    ProgressLine line(command.quiet());
    return command.run(line.observer());
  } catch (const UsageError& error) {
    return usage(name + ": " + error.what(), name);
  } catch (const Cancelled&) {
    print_error(interrupted_text());
    return interrupt_exit_code();
  } catch (const ClosedPipe&) {
    return kClosedPipe;
  } catch (const std::bad_alloc&) {
    tell_failure(name + ": not enough memory");
  } catch (const UnlikelyMetres& error) {
    tell_failure(command.with_input(error.what() + mesh_unit_hint(error)));
  } catch (const UnstatedSetting& error) {
    tell_failure(command.with_input(std::string(error.what()) + ", as " + as_option(error.example())));
  } catch (const std::exception& error) {
    tell_failure(command.with_input(error.what()));
  }
  return kBadInput;
}

// Of each command as it is without other options.
std::vector<CommandSettings> settings_of(const Program& program) {
  std::vector<CommandSettings> out;
  for (const auto& command : program.commands) out.push_back({command->parser().full_name(), command->fields()});
  return out;
}

// What is printed where no command is given.
std::string welcome() {
  return std::string("asperity ") + kVersion +
         ": measures the fine surface of real objects and renders it to the hand\n\n"
         "  asperity demo -o out     measure three simulated surfaces and compare them with the truth (seconds)\n"
         "  asperity import --help   begin with your own data: motion capture and an inertial sensor, or a table\n"
         "  asperity studio          scan, process, align, paint and render in a browser\n\n"
         "All commands: asperity --help. One of them: asperity help COMMAND. A verdict: asperity help CODE.\n";
}

int parse_and_run(Program& program, int argc, char** argv) {
  if (argc == 1) return print_text(welcome()), kDone;
  // "asperity help process" is "asperity process --help".
  std::string help = "--help";
  std::vector<char*> words(argv, argv + argc);
  if (std::string_view(words[1]) == "help") {
    words.erase(words.begin() + 1);
    const Parser* parser = &program.parser;
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (i == 1 && (std::string_view(words[i]) == "help" || words[i][0] == '-')) {
        words.resize(1);  // of help itself: that of the program
        break;
      }
      const Parser* below = parser->find(words[i]);
      if (below == nullptr && i == 1) {
        // "asperity help below_noise": a verdict's code.
        if (const std::optional<std::string> explained = explain_code(words[i])) return print_text(*explained), kDone;
      }
      if (below == nullptr)
        return usage(parser->unknown_word(words[i]), parser == &program.parser ? "" : parser->full_name());
      parser = below;
    }
    words.push_back(help.data());
    argc = static_cast<int>(words.size());
    argv = words.data();
  }
  const ParsedLine line = program.parser.parse(argc, argv);
  if (line.kind == ParsedLine::Kind::kFault) return usage(line.text, line.command);
  if (line.kind == ParsedLine::Kind::kText) return print_text(line.text), kDone;
  if (program.manual) return print_text(manual_page(program.parser)), kDone;
  if (!program.completion.empty())
    return print_text(shell_completion(program.completion, program.parser, settings_of(program))), kDone;
  for (const auto& command : program.commands) {
    if (command->parser().is_parsed()) return run_command(*command);
  }
  return usage("which command?", "");
}

int run_command_line(int argc, char** argv) {
  try {
    watch_interrupts(print_error);
    Program program;
    return parse_and_run(program, argc, argv);
  } catch (const ClosedPipe&) {
    return kClosedPipe;
  } catch (const std::bad_alloc&) {
    print_error("not enough memory");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return kBadInput;
}

}  // namespace

}  // namespace asperity::app

int main(int argc, char** argv) {
  const int code = asperity::app::run_command_line(argc, argv);
  asperity::command_ended();
  return code;
}
