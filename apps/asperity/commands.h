#pragma once

#include <memory>

#include "command.h"

namespace asperity::app {

std::unique_ptr<Command> make_area_command(Parser& root);
std::unique_ptr<Command> make_batch(Parser& root);
std::unique_ptr<Command> make_bench(Parser& root);
std::unique_ptr<Command> make_check_rig(Parser& root);
std::unique_ptr<Command> make_demo(Parser& root);
std::unique_ptr<Command> make_simulate(Parser& root);
std::unique_ptr<Command> make_feel(Parser& root);
std::unique_ptr<Command> make_import(Parser& root);
std::unique_ptr<Command> make_export(Parser& root);
std::unique_ptr<Command> make_inspect(Parser& root);
std::unique_ptr<Command> make_merge(Parser& root);
std::unique_ptr<Command> make_paint(Parser& root);
std::unique_ptr<Command> make_plot(Parser& root);
std::unique_ptr<Command> make_process(Parser& root);
std::unique_ptr<Command> make_realism(Parser& root);
std::unique_ptr<Command> make_record(Parser& root);
std::unique_ptr<Command> make_recover(Parser& root);
std::unique_ptr<Command> make_register(Parser& root);
std::unique_ptr<Command> make_report(Parser& root);
std::unique_ptr<Command> make_roughness(Parser& root);
std::unique_ptr<Command> make_studio(Parser& root);
std::unique_ptr<Command> make_track(Parser& root);

// The commands below `asperity study`.
std::unique_ptr<Command> make_study_plan(Parser& study);
std::unique_ptr<Command> make_study_run(Parser& study);
std::unique_ptr<Command> make_study_summarize(Parser& study);
std::unique_ptr<Command> make_study_table(Parser& study);

// The commands below `asperity texture`.
std::unique_ptr<Command> make_texture_fit(Parser& texture);
std::unique_ptr<Command> make_texture_info(Parser& texture);
std::unique_ptr<Command> make_texture_synthesize(Parser& texture);
std::unique_ptr<Command> make_texture_swap(Parser& texture);
std::unique_ptr<Command> make_texture_compare(Parser& texture);

// The commands below `asperity calibrate`.
std::unique_ptr<Command> make_calibrate_accel(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_camera(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_force(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_imu(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_latency(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_tracker(Parser& calibrate);
std::unique_ptr<Command> make_calibrate_tip(Parser& calibrate);

// The commands below `asperity markers`.
std::unique_ptr<Command> make_markers_sheet(Parser& markers);
std::unique_ptr<Command> make_markers_ring(Parser& markers);
std::unique_ptr<Command> make_markers_board(Parser& markers);
std::unique_ptr<Command> make_markers_charuco(Parser& markers);
std::unique_ptr<Command> make_markers_detect(Parser& markers);

}  // namespace asperity::app
