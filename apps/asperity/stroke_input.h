#pragma once

#include <string>
#include <vector>

#include "asperity/import/read_stroke.h"
#include "asperity/import/stroke.h"
#include "asperity/json/json.h"
#include "asperity/texture/compare_vibrations.h"
#include "asperity/texture/texture_fit.h"

namespace asperity::app {

// The stroke of a folder that `import --stroke` wrote. Throws Error if its verdict, judged again from its series, is
// invalid.
Stroke read_valid_stroke(const std::string& folder);

// Acceleration, speed and force for a texture's fit. Throws Error naming what is not known.
SeriesTable series_of_stroke(const std::string& folder);

// A stroke's vibration in windows of 0.25 s, with the mean speed and force of each (empty where not known).
struct StrokeVibration {
  ComparedVibration vibration;
  std::vector<double> speed_mps, force_N;
};
StrokeVibration vibration_of_stroke(const Stroke& stroke);

// For a person: what was read, the verdicts, what is not known, and the octaves of the heights.
std::string stroke_text(const Stroke& stroke);
std::string stroke_heights_text(const Stroke& stroke);
Json stroke_heights_json(const Stroke& stroke);

// Columns and their units, a line each, of the files that a stroke was read from, and the columns that nobody used.
std::string stroke_columns_text(const std::vector<ImportTable>& tables);
std::vector<const ImportTable*> pointers_to(const std::vector<ImportTable>& tables);

}  // namespace asperity::app
