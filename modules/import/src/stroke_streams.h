#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/import/import_table.h"

namespace asperity {

// A stream on the acceleration's clock, by straight lines.
struct StrokeSeries {
  std::vector<double> t_s, value;

  double at(double t) const;
};

// The axes of an acceleration, of one file or one each.
struct StrokeAcceleration {
  std::vector<StrokeSeries> axes;
  std::vector<std::size_t> table;   // that each axis is of
  std::vector<std::string> column;  // that each axis is
  std::int64_t start_ns = 0;
  double rate_Hz = 0.0;
};

// Adds the axes of table `index`. Throws Error where it has none, and for a clock too coarse for its rate.
void add_stroke_acceleration(const ImportTable& table, std::size_t index, StrokeAcceleration& out, Problems& problems);

// Sets the mean rate. Throws Error where an axis has gaps or too few samples, where the axes' rates differ by more than
// a hundredth, and where no axis ever changes.
void check_stroke_acceleration(const std::vector<ImportTable>& tables, StrokeAcceleration& out, Problems& problems);

struct StrokePath {
  std::vector<StrokeSeries> axes;
  StrokeSeries speed;
};

// Throws Error without positions, with fewer than three, and where they have a gap.
StrokePath read_stroke_path(const ImportTable& table, std::int64_t start_ns, Problems& problems);

// The force, or the length of its components. Throws Error where it has a gap.
StrokeSeries read_stroke_force(const ImportTable& table, std::int64_t start_ns, Problems& problems);

}  // namespace asperity
