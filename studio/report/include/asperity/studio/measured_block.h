#pragma once

#include <cstddef>
#include <string>

#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

struct MeasuredBlockConfig {
  std::size_t max_trajectory_points = 20'000;
  std::size_t max_profile_points = 200'000;
  std::size_t max_gaps = 200;  // that are listed
};

// All that the Process page and report.html show of one processed recording. `name` is the recording's.
//
// Head, kind "measured": "result" is result.json (write_result.h); "world" as in recording.json; "values" a list
// (measured_metrics.h); "dropped"
// [{"kind","message","count"}]; "gaps" [{"from_m","to_m","why"}] and "gap_count"; "trajectory" {"samples","every",
// "points","origin_m","duration_s"}: every `every`-th sample is there; "profile" {"samples","every",
// "points","first_m","spacing_m"}: the same; "spectrum" {"segments"}; "compliance" {"k_c","sigma_r2","exponent",
// "exponent_error","ratio_variance"}.
//
// Arrays, nan where there is nothing, n points each:
//   trajectory_t_s f64, from its first sample; trajectory_p_m f32 [n, 3] and base_p_m f32 [n, 3] from "origin_m";
//   trajectory_speed_mps f32, along the base path; trajectory_force_N f32, held over samples without a reading;
//   trajectory_sigma_m f32; trajectory_height_m f32, over the base path; trajectory_contact u8
//   profile_height_m, profile_sigma_m, profile_texture_m, profile_force_N, profile_speed_mps f32
//   spectrum_cycles_per_mm, spectrum_density_m2_mm f64: of the texture, its noise taken off (surface_spectrum.h);
//   spectrum_low_m2_mm, spectrum_high_m2_mm f64: its 95 % interval
//   compliance_force_N, compliance_ratio, compliance_speed_mps, compliance_amplitude_mps2 f64: a window each
//   compared_s_m f64, compared_measured_m, compared_true_m f32: with a truth, in the band of the comparison, aligned
BlockWriter measured_block(const ProcessResult& result, const Recording& recording, const std::string& name,
                           const MeasuredBlockConfig& config = {});
// The same with the `json` that result_json gave.
BlockWriter measured_block(const Json& json, const ProcessResult& result, const Recording& recording,
                           const MeasuredBlockConfig& config = {});

}  // namespace asperity::studio
