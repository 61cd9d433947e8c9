#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/folder_content.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// result.json: everything measured, what was dropped and why, the settings, the version. `name` is the
// recording's. nan is null. The same result gives the same bytes.
std::string format_result(const ProcessResult& result, const Recording& recording, const std::string& name);

// trajectory.csv (sigma_m: the root of a third of the covariance's trace; 12 decimals), profile.csv and spectrum.csv.
std::string format_trajectory_csv(const TipMotion& motion);
// `surface`, if it is given and determined, has its columns surface_m and touched (0 or 1).
std::string format_profile_csv(const Profile& profile, const ErodedProfile* surface = nullptr);
std::string format_spectrum_csv(const SurfaceSpectrum& spectrum);

// Writes trajectory.csv, profile.csv, spectrum.csv, texture.json (if there is a texture) and result.json into `folder`,
// which exists. Throws Error if a file cannot be written.
void write_result(const std::filesystem::path& folder, const ProcessResult& result, const Recording& recording,
                  const std::string& name);
// The same with the `json` that result_json gave.
void write_result(const std::filesystem::path& folder, const ProcessResult& result, const Json& json);

// True if `folder` holds a result.json of ours, or nothing but folders that do, or folders of such; a report.html may
// be beside. Otherwise with a file or folder that was added to such a folder. Never throws.
FolderContent is_result_folder(const std::filesystem::path& folder) noexcept;

}  // namespace asperity
