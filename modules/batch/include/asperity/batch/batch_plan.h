#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// A step of a batch: the options of its command, as they are typed.
struct BatchOptions {
  std::vector<std::string> words;

  // What of them may be a path: each word that is no option's name, and what is behind the first = of one.
  std::vector<std::string> possible_paths() const;
};

// What is to be done with many recordings. Relative paths, and those among the options, are relative to `folder`.
struct BatchPlan {
  std::filesystem::path folder = ".";   // the plan's
  std::vector<std::string> recordings;  // folders, or patterns (find_scans.h)
  std::string output;                   // folder of the results; empty: not stated
  BatchOptions process;
  std::optional<BatchOptions> texture;  // of each profile: `texture fit`
  std::optional<BatchOptions> registration;
  std::string mesh;                       // of the registration
  std::optional<BatchOptions> roughness;  // of each profile
};

// Reads a plan in TOML:
//
//   recordings = ["scans/*", "more/**/rec"]
//   output = "results"
//   [process]
//   options = ["--method", "fused"]
//   [texture]
//   options = ["--model", "stochastic"]
//   [register]
//   mesh = "pebble.obj"
//   options = ["--mesh-unit", "mm"]
//   [roughness]
//
// A table that is there asks for its step; [process] is always done. Throws Error naming `name` and the line for what
// is not TOML, an unknown key, a value of the wrong kind, an option that batch sets itself (-o, --output, --json,
// --quiet, --print-config), no recordings, or a [register] without a mesh.
BatchPlan parse_batch_plan(std::string_view text, const std::string& name);

}  // namespace asperity
