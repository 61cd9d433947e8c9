#include "asperity/pipeline/process_session.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "process_stages.h"

namespace asperity {

namespace {

using IsSame = std::function<bool(const ProcessConfig&, const ProcessConfig&)>;

// That one group of the settings is the same.
template <class Group>
IsSame same_config(Group ProcessConfig::*group) {
  return [group](const ProcessConfig& a, const ProcessConfig& b) { return is_same_config(a.*group, b.*group); };
}

// The outcome of a stage's last run, and what it was made from.
struct StageRun {
  std::optional<ProcessConfig> config;  // none: there is nothing to keep
  std::vector<std::size_t> inputs;      // the runs of the stages that it used
  std::size_t runs = 0;
};

}  // namespace

struct ProcessSession::Impl {
  Recording recording;
  ProcessResult result;
  ProcessStages s;
  StageRun trajectory, base, profile, roughness, periodicity, compliance, stiffness, friction, fit, accuracy;

  // Runs the stage unless its settings and inputs are those of its last run. What it throws goes on, and nothing of it
  // is kept then.
  template <class T, class Stage>
  void update(Outcome<T>& outcome, StageRun& last_run, const ProcessConfig& config, const IsSame& is_same,
              std::vector<std::size_t> inputs, Stage stage) {
    if (last_run.config && last_run.inputs == inputs && is_same(*last_run.config, config)) return;
    last_run.config.reset();
    ++last_run.runs;
    outcome = stage();
    last_run.config = config;
    last_run.inputs = std::move(inputs);
  }
};

ProcessSession::ProcessSession(Recording recording) : impl_(std::make_unique<Impl>()) {
  impl_->recording = std::move(recording);
}
ProcessSession::~ProcessSession() = default;
ProcessSession::ProcessSession(ProcessSession&&) noexcept = default;
ProcessSession& ProcessSession::operator=(ProcessSession&&) noexcept = default;

const Recording& ProcessSession::recording() const { return impl_->recording; }

const ProcessResult& ProcessSession::process(const ProcessConfig& config, const Observer& observer) {
  Impl& kept = *impl_;
  const Recording& recording = kept.recording;
  ProcessStages& s = kept.s;
  const ProcessMethod& method = ProcessMethods::get(config.method);

  const IsSame same_trajectory = [&](const ProcessConfig& a, const ProcessConfig& b) {
    return a.method == b.method && a.reference == b.reference && is_same_config(a.object, b.object) &&
           method.is_same_trajectory(a, b);
  };
  observer.update("trajectory", 0.0);
  kept.update(s.trajectory, kept.trajectory, config, same_trajectory, {}, [&] {
    s.on_object.reset();
    return stage::find_trajectory(recording, config, method, observer);
  });
  const Recording& in_frame = stage::in_frame(recording, s);
  observer.update("base path", 0.7);
  kept.update(s.base, kept.base, config, same_config(&ProcessConfig::base), {kept.trajectory.runs},
              [&] { return stage::find_base_path(in_frame, config, method, s); });
  // What is done to each method's profile is not the method's.
  const IsSame same_profile = [&](const ProcessConfig& a, const ProcessConfig& b) {
    return method.is_same_profile(a, b) && is_same_config(a.profile.tip, b.profile.tip) &&
           a.profile.merge_passes == b.profile.merge_passes;
  };
  observer.update("profile", 0.8);
  kept.update(s.profile, kept.profile, config, same_profile, {kept.trajectory.runs, kept.base.runs},
              [&] { return stage::find_profile(in_frame, config, method, s); });

  const std::vector<std::size_t> of_profile{kept.profile.runs};
  observer.update("roughness", 0.85);
  kept.update(s.roughness, kept.roughness, config, same_config(&ProcessConfig::roughness), of_profile,
              [&] { return stage::measure_roughness(config, s); });
  kept.update(s.periodicity, kept.periodicity, config, same_config(&ProcessConfig::periodicity), of_profile,
              [&] { return stage::find_periodicity(config, s); });
  s.spectrum = stage::measure_spectrum(s);

  // Of the profile they ask only whether there is one.
  const std::vector<std::size_t> of_base{kept.trajectory.runs, kept.base.runs, s.profile.value ? 1U : 0U};
  observer.update("compliance", 0.9);
  kept.update(s.compliance, kept.compliance, config, same_config(&ProcessConfig::compliance), of_base,
              [&] { return stage::estimate_compliance(in_frame, config, method, s); });
  kept.update(s.stiffness, kept.stiffness, config, same_config(&ProcessConfig::stiffness), of_base,
              [&] { return stage::estimate_stiffness(config, s); });
  kept.update(s.friction, kept.friction, config, same_config(&ProcessConfig::friction), of_base,
              [&] { return stage::estimate_friction(config, s); });

  observer.update("texture", 0.95);
  kept.update(s.fit, kept.fit, config, same_config(&ProcessConfig::texture), of_profile,
              [&] { return stage::fit_texture(config, s); });
  kept.update(s.accuracy, kept.accuracy, config, same_config(&ProcessConfig::comparison),
              {kept.trajectory.runs, kept.base.runs, kept.profile.runs},
              [&] { return stage::compare_with_truth(in_frame, config, method, s); });
  observer.update("texture", 1.0);
  kept.result = join_stages(recording, config, method, s);
  return kept.result;
}

}  // namespace asperity
