#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_session.h"

namespace asperity::studio {

// A scan that has been read, with its results.
struct OpenScan {
  ProcessSession session;
  std::vector<std::string> segments;  // that are processed each for itself, as `asperity process` calls their folders
  std::string segment;                // the one that this is
};

// Scans kept for the next setting, the ones used last. For one thread.
class ScanSessions {
 public:
  static constexpr std::size_t kMost = 16;

  // The scan of a recording's folder, read again if its files have changed since. `segment` "" is the whole recording,
  // or the first of its segments where they are apart. Valid until the next call. Throws Error if it cannot be read
  // or has no such segment.
  OpenScan& open(const std::filesystem::path& recording, const std::string& segment, const Observer& observer = {});

 private:
  struct KeptSession {
    std::filesystem::path recording;
    std::string segment;  // as it was asked for
    std::string stamp;
    OpenScan scan;
  };
  std::list<KeptSession> kept_;  // the last used first
};

}  // namespace asperity::studio
