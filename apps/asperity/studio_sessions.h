#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asperity/studio/running_studios.h"

namespace asperity::app {

// Which of the studios that run a command is for: by their folder, their port, or all.
struct StudioChoice {
  std::optional<std::filesystem::path> folder;
  int port = 0;  // 0: any
};

// Of this user's studios those that are meant. Throws Error if their sockets are not this user's alone.
std::vector<studio::RunningStudio> chosen_studios(const StudioChoice& choice);
// The one that is meant. Throws Error if there is none, or naming all of several.
studio::RunningStudio chosen_studio(const StudioChoice& choice);

// For a person, and for --json.
std::string sessions_text(const std::vector<studio::RunningStudio>& studios);
std::string sessions_json(const std::vector<studio::RunningStudio>& studios);

}  // namespace asperity::app
