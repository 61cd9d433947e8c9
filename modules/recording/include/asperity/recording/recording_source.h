#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// What a recording was made of.
enum class RecordingKind { kMeasured, kSimulated, kImported };
struct RecordingSource {
  RecordingKind kind = RecordingKind::kMeasured;
  std::vector<std::string> files;  // of an import: "take.csv 1a2b3c4d", name and CRC-32
};
RecordingSource source_of(const Recording& recording);

// For OutputFolder: whether a folder may be replaced by a recording of this source. A simulation replaces simulations,
// an import replaces imports of no other files than its own. Throws Error naming the folder, what it holds and what to
// do for any other recording; false for folders that hold anything else.
std::function<bool(const std::filesystem::path&)> replaceable_by(RecordingSource source);

}  // namespace asperity
