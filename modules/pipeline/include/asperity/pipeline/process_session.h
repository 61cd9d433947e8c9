#pragma once

#include <memory>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// One recording processed again and again with other settings, as a person tunes them: a stage whose settings and
// inputs have not changed is not run again. Not thread-safe.
class ProcessSession {
 public:
  explicit ProcessSession(Recording recording);
  ~ProcessSession();
  ProcessSession(ProcessSession&&) noexcept;
  ProcessSession& operator=(ProcessSession&&) noexcept;

  const Recording& recording() const;

  // What process_recording() gives for these settings, to the last bit. Valid until the next call. Throws as it does,
  // and what has been worked out by then is kept.
  const ProcessResult& process(const ProcessConfig& config, const Observer& observer = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
