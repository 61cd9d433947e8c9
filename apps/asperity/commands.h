#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "command.h"

namespace asperity::app {

std::unique_ptr<Command> make_bench(CLI::App& root);
std::unique_ptr<Command> make_check_rig(CLI::App& root);
std::unique_ptr<Command> make_demo(CLI::App& root);
std::unique_ptr<Command> make_simulate(CLI::App& root);
std::unique_ptr<Command> make_feel(CLI::App& root);
std::unique_ptr<Command> make_import(CLI::App& root);
std::unique_ptr<Command> make_export(CLI::App& root);
std::unique_ptr<Command> make_inspect(CLI::App& root);
std::unique_ptr<Command> make_paint(CLI::App& root);
std::unique_ptr<Command> make_process(CLI::App& root);
std::unique_ptr<Command> make_record(CLI::App& root);
std::unique_ptr<Command> make_register(CLI::App& root);
std::unique_ptr<Command> make_report(CLI::App& root);
std::unique_ptr<Command> make_roughness(CLI::App& root);
std::unique_ptr<Command> make_studio(CLI::App& root);
std::unique_ptr<Command> make_track(CLI::App& root);

// The commands below `asperity study`.
std::unique_ptr<Command> make_study_summarize(CLI::App& study);

// The commands below `asperity texture`.
std::unique_ptr<Command> make_texture_fit(CLI::App& texture);
std::unique_ptr<Command> make_texture_info(CLI::App& texture);
std::unique_ptr<Command> make_texture_synthesize(CLI::App& texture);
std::unique_ptr<Command> make_texture_swap(CLI::App& texture);
std::unique_ptr<Command> make_texture_compare(CLI::App& texture);

// The commands below `asperity calibrate`.
std::unique_ptr<Command> make_calibrate_accel(CLI::App& calibrate);
std::unique_ptr<Command> make_calibrate_camera(CLI::App& calibrate);
std::unique_ptr<Command> make_calibrate_force(CLI::App& calibrate);
std::unique_ptr<Command> make_calibrate_latency(CLI::App& calibrate);
std::unique_ptr<Command> make_calibrate_tracker(CLI::App& calibrate);
std::unique_ptr<Command> make_calibrate_tip(CLI::App& calibrate);

// The commands below `asperity markers`.
std::unique_ptr<Command> make_markers_sheet(CLI::App& markers);
std::unique_ptr<Command> make_markers_ring(CLI::App& markers);
std::unique_ptr<Command> make_markers_board(CLI::App& markers);
std::unique_ptr<Command> make_markers_charuco(CLI::App& markers);
std::unique_ptr<Command> make_markers_detect(CLI::App& markers);

}  // namespace asperity::app
