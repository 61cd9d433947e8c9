#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace asperity::studio {

// A recording that was open when a studio ended without finishing it (a power cut, SIGKILL): what is left of it.
struct RescuedScan {
  std::string recording;
  double duration_s = 0.0;  // of its samples; 0 if it cannot be read
  std::string problem;      // why it cannot be read
};

// Notes in `folder` that `recording` is open; forget_open_scan() removes the note. Throws Error.
void note_open_scan(const std::filesystem::path& folder, const std::string& recording);
void forget_open_scan(const std::filesystem::path& folder) noexcept;

// The noted recording, read; nothing without a note, and where no sample of it was stored. May take long.
std::optional<RescuedScan> find_rescued_scan(const std::filesystem::path& folder);

}  // namespace asperity::studio
