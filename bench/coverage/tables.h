#pragma once

#include <filesystem>
#include <vector>

#include "judge_case.h"

namespace bench {

// Markdown on standard output.
void print_figures(const std::vector<ScanOutcome>& scans);        // coverage of the intervals, pooled and by family
void print_false_pitches(const std::vector<ScanOutcome>& scans);  // where the surface has no pattern
void print_verdicts(const std::vector<ScanOutcome>& scans);       // what is trusted, by the correlation with the truth
void print_sigmas(const std::vector<ScanOutcome>& scans);         // error over stated sigma, by family and probe
void print_conditions(const std::vector<ScanOutcome>& scans);     // the same by what else was drawn
void print_bands(const std::vector<ScanOutcome>& scans);          // the texture's error by frequency, actual and said

// One row a scan and figure.
void write_csv(const std::filesystem::path& path, const std::vector<ScanOutcome>& scans);

}  // namespace bench
