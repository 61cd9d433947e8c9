#include "record_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "asperity/base/text.h"

namespace asperity::app {

namespace {

double share(std::uint64_t part, std::uint64_t rest) {
  return part + rest == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(part + rest);
}

void judge_poses(const RecorderSnapshot& end, const RecordVerdictConfig& config, RecordVerdict& out) {
  if (end.poses.state == SensorState::kAbsent) {
    out.warnings.push_back("there was no tracker: accelerometer and force alone");
    return;
  }
  if (end.tracking.poses == 0) {
    out.doubts.push_back(end.tracking.frames == 0 ? "not one image or pose came" : "no pose was found in any image");
    if (!end.poses.message.empty()) out.doubts.back() += " (" + printable(end.poses.message, 300) + ")";
    return;
  }
  if (end.tracker_rows == 0) out.doubts.push_back("no pose lies in what was stored");
  const std::uint64_t tried = end.tracking.frames - end.tracking.skipped_frames;
  const double seen = static_cast<double>(end.tracking.poses) / static_cast<double>(std::max<std::uint64_t>(tried, 1));
  if (seen < config.smallest_seen_share)
    out.doubts.push_back(fmt::format("the markers were seen in only {:.0f} % of the images", 100.0 * seen));
  if (end.poses.overflowed > 0)
    out.doubts.push_back(fmt::format("{} poses did not reach the disk", end.poses.overflowed));
  if (end.tracking.skipped_frames > 0)
    out.warnings.push_back(
        fmt::format("{} images were passed over: tracking is slower than the camera", end.tracking.skipped_frames));
}

}  // namespace

RecordVerdict judge_recording(const RecorderSnapshot& end, bool asked_for_contact, bool calibrated,
                              const RecordVerdictConfig& config) {
  RecordVerdict out;
  const LinkStatistics& link = end.link;
  if (end.probe.received == 0) {
    out.doubts.push_back("not one sample came from the probe");
    if (!end.probe.message.empty()) out.doubts.back() += " (" + printable(end.probe.message, 300) + ")";
  } else if (asked_for_contact && end.touches == 0) {
    out.doubts.push_back("the probe never touched");
  } else if (end.probe_rows == 0) {
    out.doubts.push_back("nothing was stored");
  }
  const double lost = share(link.lost_samples, link.samples);
  if (lost > config.largest_lost_share) {
    out.doubts.push_back(fmt::format("{:.2g} % of the probe's samples were lost{}", 100.0 * lost,
                                     link.losses_are_estimated ? " (estimated from time)" : ""));
  }
  if (end.probe.overflowed > 0)
    out.doubts.push_back(fmt::format("{} samples did not reach the disk in time", end.probe.overflowed));
  if (end.columns_missing)
    out.doubts.push_back("the probe described itself too late: not all of its sensors were stored");
  if (link.overruns > 0)
    out.warnings.push_back(fmt::format("the probe dropped samples itself {} times", link.overruns));
  judge_poses(end, config, out);
  for (const auto& [what, sensor] : {std::pair{"the probe", &end.probe}, {"the tracker", &end.poses}}) {
    if (sensor->failed)
      out.doubts.push_back(fmt::format("{} ended by a fault: {}", what, printable(sensor->message, 300)));
    if (sensor->lost > 0 && sensor->state != SensorState::kEnded)
      out.warnings.push_back(fmt::format("{} disappeared {} times", what, sensor->lost));
  }
  if (end.gravity.implausible) {
    out.doubts.push_back("gravity at rest is not near 9.8 m/s²: the accelerometer's calibration is of another probe");
  } else if (!end.gravity.measured && calibrated && end.tracking.poses > 0) {
    out.warnings.push_back("the probe was never at rest: gravity is assumed, not measured");
  }
  if (!calibrated) out.warnings.push_back("there is no calibration: counts and poses only");
  return out;
}

}  // namespace asperity::app
