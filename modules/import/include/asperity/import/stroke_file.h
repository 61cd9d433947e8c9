#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/import/stroke.h"
#include "asperity/json/json.h"
#include "asperity/recording/read_limits.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// Writes stroke.csv, stroke.json and, where they can be known, vibration.csv and spectrum.csv (docs/import.md); gives
// stroke.json.
Json write_stroke(const std::filesystem::path& folder, const Stroke& stroke, const std::vector<StrokeOrigin>& sources);

// True for a folder with a stroke.json.
bool is_stroke_folder(const std::filesystem::path& folder);

// What a folder holds that was not made of these files, as "a stroke of acc.csv"; "" for a stroke of these files alone.
std::string source_beyond(const std::filesystem::path& folder, const std::vector<StrokeOrigin>& sources);

// The stroke of a folder. Throws Error naming file, line and column for what write_stroke does not write.
Stroke read_stroke_folder(const std::filesystem::path& folder, const ReadLimits& limits = {});

// What a stroke cannot say for want of positions, force or axes, a sentence each.
std::vector<std::string> stroke_unknowns(const Stroke& stroke);

}  // namespace asperity
