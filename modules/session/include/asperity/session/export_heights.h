#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/profile/read_heights.h"
#include "asperity/scene/export_scene.h"

namespace asperity {

// Files of surface instruments.
enum class HeightFile { kX3p, kSdf, kSdfBinary, kGsf };
inline constexpr std::array<std::string_view, 4> kHeightFileNames{"x3p", "sdf", "sdf-binary", "gsf"};

// Of the names above; nullopt for another.
std::optional<HeightFile> height_file_of(std::string_view name);

// A file of heights: neither a scene nor a texture (.json) nor a mesh.
bool holds_heights_alone(const std::filesystem::path& source);

// Heights at their own spacing, missing ones marked: of a folder the whole of its profile.csv (height_m), as
// profile.<ending>, and each areal map of its scene between its outer supported points, as <texture>.map.<ending>;
// of a file of heights the same heights. Empty of a folder without either. A map is evaluated at the points of its
// splines; where no height was near it is missing. Throws Error where a file cannot be read or the format holds no such
// grid.
ExportResult export_heights(const std::filesystem::path& source, HeightFile format,
                            const ReadHeightsConfig& reading = {}, const Observer& observer = {});

}  // namespace asperity
