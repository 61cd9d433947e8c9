#pragma once

#include <optional>

#include "asperity/studio/page.h"
#include "scan/open_scan.h"

namespace asperity::studio {

// The scan that a studio before this one did not finish (open_scan.h), for the browsers: "scan.rescued", and
// "scan.forget_rescued" when the user has seen it. Event "rescued": it has changed. On the studio's thread.
class RescuedScanCalls {
 public:
  explicit RescuedScanCalls(Shared& shared) : shared_(shared) {}

  void bind(Calls& calls);
  // Looks for it, in a job. Before a source is opened, which has a note of its own.
  void start();

 private:
  Shared& shared_;
  std::optional<RescuedScan> rescued_;
};

}  // namespace asperity::studio
