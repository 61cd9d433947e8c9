#include "asperity/pipeline/process_recording.h"

#include <utility>

#include "asperity/pipeline/process_motion.h"
#include "process_stages.h"

namespace asperity {

ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const ProcessMethod& method,
                                const Observer& observer) {
  ProcessStages s;

  // Where the tip was (seed §4.1 to §4.3).
  observer.update("trajectory", 0.0);
  s.trajectory = stage::find_trajectory(recording, config, method, observer);

  // An object that moved has taken its frame along: from here on that is the world.
  const Recording& in_frame = stage::in_frame(recording, s);

  // The path without the fine motion, and its normals (seed §1.4, §6.2; errata 23 and 24).
  observer.update("base path", 0.7);
  s.base = stage::find_base_path(in_frame, config, method, s);

  // The height along it (seed §5.1).
  observer.update("profile", 0.8);
  s.profile = stage::find_profile(in_frame, config, method, s);

  // What it says of the surface (seed §5.2).
  observer.update("roughness", 0.85);
  s.periodicity = stage::find_periodicity(config, s);
  s.roughness = stage::measure_roughness(config, s);
  s.spectrum = stage::measure_spectrum(s);

  // How it yields (seed §5.3, erratum 15).
  observer.update("compliance", 0.9);
  s.compliance = stage::estimate_compliance(in_frame, config, method, s);
  s.stiffness = stage::estimate_stiffness(config, s);

  // How it rubs (seed §7.2: "a tri-axial force sensor").
  s.friction = stage::estimate_friction(config, s);

  // What a hand is to feel of it (seed §6.5, erratum 18).
  observer.update("texture", 0.95);
  s.fit = stage::fit_texture(config, s);

  // How far it is from the truth, where the recording knows it.
  s.accuracy = stage::compare_with_truth(in_frame, config, method, s);

  observer.update("texture", 1.0);
  return join_stages(recording, config, method, std::move(s));
}

ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  return process_recording(recording, config, ProcessMethods::get(config.method), observer);
}

ProcessResult estimate_motion(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  const ProcessMethod& method = ProcessMethods::get(config.method);
  ProcessStages s;
  observer.update("trajectory", 0.0);
  s.trajectory = stage::find_trajectory(recording, config, method, observer);
  return join_stages(recording, config, method, std::move(s));
}

void measure_along(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                   ProcessResult& result, const Observer& observer) {
  ProcessMethod method = ProcessMethods::get(config.method);
  method.estimate_trajectory = [&result](const Recording&, const ProcessConfig&, const Observer&) {
    return std::move(result.trajectory);
  };
  method.find_base_path = [&find_base](const Recording&, const ProcessConfig&, const TipMotion& motion) {
    return find_base(motion);
  };
  result = process_recording(recording, config, method, observer);
}

}  // namespace asperity
