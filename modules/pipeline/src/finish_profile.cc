#include <utility>

#include "asperity/profile/erode_profile.h"
#include "process_stages.h"

namespace asperity {

namespace {

// The surface under the tip; the tip's radius is the calibration's unless one is given.
void erode(const Calibration& calibration, const TipConfig& config, MeasuredProfile& measured) {
  const double radius_m = config.radius_m > 0.0 ? config.radius_m : calibration.tip_radius_m;
  measured.surface = erode_profile(measured.profile, measured.noise, radius_m);
}

}  // namespace

void finish_profile(const Recording& recording, const ProcessConfig& config, MeasuredProfile& measured) {
  measured.as_measured = measured.profile;
  measured.noise_as_measured = measured.noise;
  if (config.profile.remove_noise) remove_noise(config.profile.bridge_m, measured.profile, measured.noise);
  measured.coverage = measure_coverage(measured.profile);
  if (config.profile.tip.mode == TipMode::kErode) erode(recording.calibration, config.profile.tip, measured);
}

void measure_again(const Recording& recording, const ProcessConfig& config, MeasuredProfile measured,
                   ProcessResult& result) {
  const ProcessMethod& method = ProcessMethods::get(config.method);
  finish_profile(recording, config, measured);
  ProcessStages s;
  s.trajectory.value = std::move(result.trajectory);
  s.base.value = std::move(result.base);
  s.profile.value = std::move(measured);
  s.periodicity = stage::find_periodicity(config, s);
  s.roughness = stage::measure_roughness(config, s);
  s.spectrum = stage::measure_spectrum(s);
  s.compliance.value = std::move(result.compliance);
  s.stiffness.value = std::move(result.stiffness);
  s.friction.value = std::move(result.friction);
  s.fit = stage::fit_texture(config, s);
  s.accuracy = stage::compare_with_truth(stage::in_frame(recording, s), config, method, s);
  Problems problems = std::move(result.problems);
  result = join_stages(recording, config, method, std::move(s));
  result.problems = std::move(problems);
}

}  // namespace asperity
