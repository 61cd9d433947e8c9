#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/link/link_statistics.h"
#include "asperity/link/probe_description.h"
#include "asperity/link/probe_link.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

// Where a probe's samples come from. One thread at a time.
class ProbeSource {
 public:
  virtual ~ProbeSource() = default;

  // Waits at most `timeout` for samples and appends those that are there to `out`; their times are on the host's
  // clock and rise strictly. Throws LinkLost when no more can come, Error for anything else that fails.
  virtual void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) = 0;

  virtual LinkStatistics statistics() const = 0;
  virtual std::optional<ProbeDescription> description() const = 0;
  virtual std::string name() const = 0;
};

std::unique_ptr<ProbeSource> make_probe_source(ProbeLink link);

}  // namespace asperity
