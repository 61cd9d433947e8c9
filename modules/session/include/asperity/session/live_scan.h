#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/simulation/live_bench.h"

namespace asperity {

// A scan that is played live, with the files that its reader needs beside the FIFO: calibration.json, camera.json and
// markers.json, all exact.
class LiveScan {
 public:
  // Writes the files into `folder`, which has to exist.
  LiveScan(const Recording& recording, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
           const std::filesystem::path& folder);

  std::string port() const { return bench_.port(); }
  std::string camera() const { return bench_.camera(); }
  std::string calibration() const { return (folder_ / "calibration.json").string(); }
  std::string markers() const { return (folder_ / "markers.json").string(); }
  // What to open, on one line.
  Json announcement() const;

  // Waits for both readers and plays. Throws Error if they don't come in time.
  LiveReport play(const Observer& observer);
  Recording on_host_clock() const { return bench_.on_host_clock(); }

 private:
  std::filesystem::path folder_;
  std::string probe_;
  LiveBenchConfig config_;
  LiveBench bench_;
};

Json live_json(const LiveReport& report, const std::string& recording);
std::string live_line(const LiveReport& report, const std::string& recording);

}  // namespace asperity
