#include "asperity/verdict/judge_recording.h"

#include <algorithm>

#include <fmt/format.h>

#include "asperity/base/text.h"
#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr std::size_t kLongestMessage = 300;

std::string with_message(const std::string& what, const std::string& message) {
  return message.empty() ? what : what + " (" + printable(message, kLongestMessage) + ")";
}

std::string times(std::uint64_t count) { return count == 1 ? "once" : fmt::format("{} times", count); }

void judge_probe(const RecordingEvidence& e, const JudgeRecordingConfig& config, Verdicts& out) {
  if (e.samples == 0) {
    out.push_back(make_verdict("no_samples", with_message("the probe sent no samples", e.probe_message)));
  } else if (e.awaits_contact && e.touches == 0) {
    out.push_back(make_verdict("never_touched", "the probe never touched a surface"));
  } else if (e.rows_stored == 0) {
    out.push_back(make_verdict("nothing_stored", "nothing was stored"));
  }
  const double lost =
      e.samples_sent == 0 ? 0.0 : static_cast<double>(e.samples_lost) / static_cast<double>(e.samples_sent);
  if (lost > config.largest_lost_share) {
    out.push_back(make_verdict("samples_lost", fmt::format("{:.2g} % of the probe's samples were lost{}", 100.0 * lost,
                                                           e.losses_are_estimated ? " (estimated from time)" : "")));
  }
  if (e.samples_overflowed > 0) {
    out.push_back(
        make_verdict("disk_too_slow", fmt::format("{} samples did not reach the disk in time", e.samples_overflowed)));
  }
  if (e.columns_missing) {
    out.push_back(
        make_verdict("columns_missing", "the probe described itself too late: not all of its sensors were stored"));
  }
  if (e.overruns > 0)
    out.push_back(make_verdict("probe_overruns", "the probe dropped samples itself " + times(e.overruns)));
  if (!e.sensor_faults.empty()) {
    out.push_back(make_verdict(
        "sensor_faults", "the probe reports faults of its sensors: " + printable(e.sensor_faults, kLongestMessage)));
  }
}

void judge_tracker(const RecordingEvidence& e, const JudgeRecordingConfig& config, Verdicts& out) {
  if (!e.has_tracker) {
    out.push_back(make_verdict("no_tracker", "the recording has no tracker: accelerometer and force alone"));
    return;
  }
  if (e.poses == 0) {
    out.push_back(make_verdict(
        "no_poses", with_message(e.frames == 0 ? "neither images nor poses arrived" : "no pose was found in any image",
                                 e.tracker_message)));
    return;
  }
  if (e.poses_stored == 0) out.push_back(make_verdict("no_poses", "the stored recording has no pose"));
  const std::uint64_t tried = std::max<std::uint64_t>(e.frames - e.frames_skipped, 1);
  const double seen = static_cast<double>(e.poses) / static_cast<double>(tried);
  if (seen < config.smallest_seen_share) {
    out.push_back(make_verdict("markers_hidden",
                               fmt::format("the markers were seen in only {:.0f} % of the images", 100.0 * seen)));
  }
  if (e.poses_overflowed > 0)
    out.push_back(make_verdict("disk_too_slow", fmt::format("{} poses did not reach the disk", e.poses_overflowed)));
  if (e.frames_skipped > 0) {
    out.push_back(make_verdict(
        "images_skipped", fmt::format("{} images were skipped: tracking is slower than the camera", e.frames_skipped)));
  }
  if (e.frames_not_kept > 0) {
    out.push_back(make_verdict(
        "frames_not_kept", fmt::format("{} images were not stored: the disk or PNG is too slow", e.frames_not_kept)));
  }
}

}  // namespace

Verdicts judge_recording(const RecordingEvidence& evidence, const JudgeRecordingConfig& config) {
  Verdicts out;
  judge_probe(evidence, config, out);
  judge_tracker(evidence, config, out);
  for (const RecordingEvidence::Source& source : evidence.sources) {
    if (source.failed) {
      out.push_back(make_verdict("source_failed", fmt::format("{} ended by a fault: {}", source.name,
                                                              printable(source.message, kLongestMessage))));
    }
    if (source.lost > 0 && !source.ended)
      out.push_back(make_verdict("source_interrupted", source.name + " disappeared " + times(source.lost)));
  }
  if (evidence.gravity_implausible) {
    out.push_back(make_verdict("gravity_implausible",
                               "gravity is not near 9.8 m/s² while the probe is stationary: the accelerometer's "
                               "calibration belongs to another probe"));
  } else if (!evidence.gravity_measured && evidence.calibrated && evidence.poses > 0) {
    out.push_back(make_verdict("gravity_assumed", "the probe was never stationary: gravity is assumed, not measured"));
  }
  if (!evidence.calibrated)
    out.push_back(make_verdict("no_calibration", "the recording has no calibration: counts and poses only"));
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
