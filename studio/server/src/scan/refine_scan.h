#pragma once

#include <string>
#include <utility>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_session.h"
#include "asperity/studio/block.h"
#include "scan/scan_session.h"

namespace asperity::studio {

// A stroke that has ended, worked out in full again and again as its settings are tuned. On the jobs' thread alone.
class ScanRefiner {
 public:
  // Takes the rows over.
  explicit ScanRefiner(FinishedScan scan);

  // The refined profile (s_m, height_m, sigma_m, texture_m, force_N, speed_mps), and in the head what is known of it:
  // "recording", "segment", "took_s", "trustworthy", "verdict", "verdicts", "roughness", and as "difference" how the
  // causal one differs from it. Throws Error where the recording or a setting allows no profile, and Cancelled.
  BlockWriter refine(const ProcessConfig& config, const Observer& observer);

  // It has another name in the recording since it was brought back.
  void rename(std::string segment) { segment_ = std::move(segment); }

  // What the causal profile has become by a tuning.
  void set_live(LiveHeights live) {
    live_ = std::move(live);
    only_live_ = true;
  }

 private:
  std::string recording_;
  std::string segment_;
  LiveHeights live_;
  bool only_live_ = false;  // nothing else has changed since the last time
  double took_s_ = 0.0;
  ProcessSession session_;
};

}  // namespace asperity::studio
