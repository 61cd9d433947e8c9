#pragma once

#include <filesystem>

#include "asperity/base/progress.h"

namespace asperity::studio {

// The name of the sample project's folder, and of the recording in it that is shown first.
inline constexpr const char* kSampleFolder = "sample";
inline constexpr const char* kSampleRecording = "protoboard";

// Writes the sample project into `folder`, which is there and empty: three simulated scans (protoboard, sandpaper,
// cable tie) with the results and textures that the command line would make of them, the profile of a real surface by a
// stylus instrument with its licence, and a README.txt that states what is what. The same files each time. Throws Error
// and Cancelled.
void write_sample_project(const std::filesystem::path& folder, const Observer& observer);

}  // namespace asperity::studio
