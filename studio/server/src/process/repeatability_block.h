#pragma once

#include <string>
#include <vector>

#include "asperity/pipeline/measure_repeatability.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// Several scans over one another, for the browser. Head, kind "repeatability": "scans" [{"name","correlation","rms_um",
// "gain","shift_m","compared_m","pitch_m","depth_m"}], the first one's with itself; "values" as in measured_metrics.h;
// "band_cycles_per_mm" [low, high]. Arrays: s_m f64 [n]; height_m f32 [scans, n], band-passed and shifted;
// mean_m, low_m, high_m f32 [n], the mean and one standard deviation to either side.
BlockWriter repeatability_block(const Repeatability& repeatability, const std::vector<RepeatedScan>& scans,
                                const std::vector<std::string>& names, const ComparisonConfig& config);

}  // namespace asperity::studio
