#include "asperity/pipeline/process_session.h"

#include <utility>

#include "kept_stages.h"
#include "run_stages.h"

namespace asperity {

struct ProcessSession::Impl {
  Recording recording;
  ProcessResult result;
  KeptStages kept;
};

ProcessSession::ProcessSession(Recording recording)
    : impl_(std::make_unique<Impl>(Impl{std::move(recording), {}, {}})) {}
ProcessSession::~ProcessSession() = default;
ProcessSession::ProcessSession(ProcessSession&&) noexcept = default;
ProcessSession& ProcessSession::operator=(ProcessSession&&) noexcept = default;

const Recording& ProcessSession::recording() const { return impl_->recording; }

const ProcessResult& ProcessSession::process(const ProcessConfig& config, const Observer& observer) {
  auto& [recording, result, kept] = *impl_;
  run_motion_stages(recording, config, kept, result, observer);
  run_surface_stages(recording, config, base_path_finder(recording, config), kept, result, observer);
  return result;
}

}  // namespace asperity
