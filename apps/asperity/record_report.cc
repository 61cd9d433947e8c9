#include "record_report.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/verdict/verdict_json.h"
#include "json_of.h"

namespace asperity::app {

namespace {

Json sensor_json(const SensorSnapshot& sensor) {
  Json out;
  out["source"] = sensor.name;
  out["rows_received"] = sensor.received;
  out["overflowed"] = sensor.overflowed;
  out["highest_queue_fill"] = sensor.highest_queue_fill;
  out["disappeared"] = sensor.lost;
  out["returned"] = sensor.returned;
  out["warnings"] = sensor.warnings;
  return out;
}

Json link_json(const LinkStatistics& link) {
  Json out;
  out["frames"] = link.frames;
  out["lost_frames"] = link.lost_frames;
  out["lost_samples"] = link.lost_samples;
  out["losses_are_estimated"] = link.losses_are_estimated;
  out["damaged_frames"] = link.damaged_frames;
  out["late_frames"] = link.late_frames;
  out["resyncs"] = link.resyncs;
  out["restarts"] = link.restarts;
  out["overruns"] = link.overruns;
  out["sensor_faults"] = describe_faults(link.faults);
  return out;
}

}  // namespace

std::string record_json(const RecordOutcome& outcome, const std::vector<ConfigField>& config) {
  const RecorderSnapshot& f = outcome.recorder;
  Json out;
  out["format"] = "asperity-recorded";
  out["version"] = 1;
  out["recording"] = outcome.recording;
  out["end"] = outcome.end;
  out["recorded_s"] = f.recorded_s;
  out["segments"] = f.segments;
  out["discarded_segments"] = f.discarded;
  out["touches"] = f.touches;
  out["probe_rows"] = f.probe_rows;
  out["tracker_rows"] = f.tracker_rows;
  out["disk_bytes"] = f.disk_bytes;
  out["highest_write_s"] = f.highest_write_s;
  out["probe"] = sensor_json(f.probe);
  out["link"] = link_json(f.link);
  if (f.poses.state != SensorState::kAbsent) {
    out["tracker"] = sensor_json(f.poses);
    out["tracker"]["frames"] = f.tracking.frames;
    out["tracker"]["poses"] = f.tracking.poses;
    out["tracker"]["skipped_frames"] = f.tracking.skipped_frames;
  }
  out["frames_kept"] = outcome.frames.written;
  out["frames_not_kept"] = outcome.frames.dropped;
  out["gravity"] = {{"measured", f.gravity.measured},
                    {"gravity_world_mps2", json_of(f.gravity.gravity_world_mps2)},
                    {"scatter_mps2", json_of(f.gravity.scatter_mps2)},
                    {"windows_at_rest", f.gravity.windows}};
  out["trustworthy"] = is_trustworthy(outcome.verdicts);
  out["verdict"] = verdict_sentence(outcome.verdicts);
  out["verdicts"] = verdicts_json(outcome.verdicts);
  out["warnings"] = Json::array();  // the messages of the limited ones, as before there were verdicts
  for (const Verdict& verdict : outcome.verdicts) {
    if (verdict.severity == Severity::kLimited) out["warnings"].push_back(verdict.message);
  }
  out["config"] = config_json(config);
  out["asperity"] = kVersion;
  return out.dump_repaired(2);
}

std::string record_text(const RecordOutcome& outcome) {
  const RecorderSnapshot& f = outcome.recorder;
  std::string out =
      fmt::format("{}: {:.1f} s in {} segment{}, {} probe rows, {} poses\n", printable(outcome.recording, 200),
                  f.recorded_s, f.segments, f.segments == 1 ? "" : "s", f.probe_rows, f.tracker_rows);
  if (f.link.lost_samples + f.link.damaged_frames > 0) {
    out += fmt::format("  link        {} samples lost{}, {} frames damaged\n", f.link.lost_samples,
                       f.link.losses_are_estimated ? " (estimated)" : "", f.link.damaged_frames);
  }
  if (f.link.faults.any()) out += fmt::format("  sensors     {}\n", describe_faults(f.link.faults));
  if (f.gravity.measured) {
    const Eigen::Vector3d& g = f.gravity.gravity_world_mps2;
    out += fmt::format("  gravity     ({:.3f}, {:.3f}, {:.3f}) m/s² in the world, from {} stationary moments\n", g.x(),
                       g.y(), g.z(), f.gravity.windows);
  }
  if (f.discarded > 0) out += fmt::format("  discarded   {} segments\n", f.discarded);
  if (outcome.frames.written > 0) out += fmt::format("  images      {} stored\n", outcome.frames.written);
  return out;
}

}  // namespace asperity::app
