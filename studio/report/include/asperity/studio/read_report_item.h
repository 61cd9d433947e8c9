#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/studio/report_item.h"

namespace asperity::studio {

inline constexpr std::size_t kMaxReportItems = 64;

// The folders at and below `folder`, three levels deep, that hold a result (a result.json), sorted by name. Throws
// Error if there is none, if there are more than kMaxReportItems, or if `folder` is none.
std::vector<std::filesystem::path> find_results(const std::filesystem::path& folder);

// What the files of one result, result.json, profile.csv and trajectory.csv, give for a report; the last may be
// missing; or the block of this very result in the report.html next to them, which holds more. `name` is what the
// report calls it; empty: the recording's. Throws Error naming file, line and value.
ReportItem read_report_item(const std::filesystem::path& folder, const std::string& name = {});

// The same from the files' texts; messages call them as they are called in `folder`. No trajectory: nullopt.
ReportItem parse_report_item(std::string_view result, std::string_view profile,
                             const std::optional<std::string_view>& trajectory, const std::filesystem::path& folder,
                             const std::string& name = {});

}  // namespace asperity::studio
