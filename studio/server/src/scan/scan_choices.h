#pragma once

#include <map>
#include <string>

#include "asperity/session/record_input.h"
#include "asperity/studio/block.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

enum class SourceKind { kBench, kHardware, kReplay };

// What a user has decided on the Scan page: the document's section "scan".
struct ScanChoices {
  SourceKind source = SourceKind::kBench;
  RecordInput hardware;  // as typed; files are names in the project's folder
  std::string world = "camera";
  std::string recording;                        // that is replayed
  std::string segment;                          // of it; empty: all
  std::string object;                           // what is scanned
  std::string name = "scan";                    // of the folder that is made for it
  bool automatic = false;                       // store while the probe touches
  std::map<std::string, std::string> settings;  // as in TOML, by their path
};

// The section as it begins.
Json first_scan_section();

// Takes the section apart. Throws Error in words naming the key: unknown, of another type, too many or too long.
ScanChoices read_scan_choices(const Json& section);

// The hardware's addresses and files with the project's files as paths: anything that is not a device must be in the
// project's folder, and a device in /dev. Throws Error naming the choice.
RecordInput resolve_hardware(const RecordInput& typed, const Project& project);

}  // namespace asperity::studio
