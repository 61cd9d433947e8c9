#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "asperity/studio/web_server.h"

namespace asperity::studio {

struct FeelConfig;

struct StudioConfig {
  WebServerConfig server;
  bool remote_force = false;  // forces also where the host is not this machine's own
  std::filesystem::path folder;
  // The user's list of projects (recent_projects_file()): a studio uses the port that it had before in its folder, if
  // no port is asked for and that one is free. Empty: no list is kept.
  std::filesystem::path recent;
  std::optional<std::string> open;         // recording, scene or mesh in it that is opened first
  std::shared_ptr<const FeelConfig> feel;  // with what the Feel page starts (feel_config.h); null: the defaults
  // What the person who started it should know, in a sentence; called on any thread. May be empty.
  std::function<void(const std::string& sentence)> notice;
};

// $XDG_STATE_HOME/asperity/studio.json, or below ~/.local/state; empty without a home.
std::filesystem::path recent_projects_file();

// Runs the studio until `stop`. `started` is given the address. Throws Error if it cannot begin, and after its end if
// the last changes or a log could not be stored.
void run_studio(const StudioConfig& config, const std::function<void(const std::string& address)>& started,
                const std::atomic<bool>& stop);

}  // namespace asperity::studio
