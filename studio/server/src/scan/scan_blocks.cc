#include "scan/scan_blocks.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/text.h"
#include "json_pose.h"

namespace asperity::studio {

namespace {

constexpr std::array<std::string_view, 5> kStateNames{"absent", "running", "silent", "lost", "ended"};

Json sensor_json(const SensorSnapshot& sensor) {
  Json out;
  out["state"] = kStateNames.at(static_cast<std::size_t>(sensor.state));
  out["name"] = printable(sensor.name, 200);
  out["message"] = printable(sensor.message, 300);
  out["warnings"] = Json::array();
  for (const std::string& warning : sensor.warnings) out["warnings"].push_back(printable(warning, 300));
  out["rate_Hz"] = sensor.rate_Hz;
  out["received"] = sensor.received;
  out["lost"] = sensor.lost;
  out["returned"] = sensor.returned;
  out["queue_fill"] = sensor.queue_fill;
  out["overflowed"] = sensor.overflowed;
  return out;
}

Json link_json(const LinkStatistics& link) {
  Json out;
  out["samples"] = link.samples;
  out["lost_samples"] = link.lost_samples;
  out["damaged_frames"] = link.damaged_frames;
  out["estimated"] = link.losses_are_estimated;
  return out;
}

Json segment_json(const Segment& segment) {
  Json out;
  out["name"] = printable(segment.name, 100);
  out["duration_s"] = 1e-9 * static_cast<double>(segment.end_ns - segment.start_ns);
  return out;
}

Json segments_json(const RecorderSnapshot& now) {
  constexpr std::size_t kMostListed = 200;
  Json out = Json::array();
  const std::size_t count = now.segment_list.size();
  for (std::size_t i = count > kMostListed ? count - kMostListed : 0; i < count; ++i) {
    Json each = segment_json(now.segment_list[i]);
    each["open"] = now.storing && i + 1 == count;
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace

BlockWriter probe_block(std::span<const ProbeSample> rows, std::uint64_t first_row, std::uint64_t dropped,
                        std::int64_t origin_ns, const std::optional<Calibration>& calibration) {
  std::vector<double> t_s;
  std::vector<float> force, accel;
  t_s.reserve(rows.size());
  force.reserve(rows.size());
  accel.reserve(3 * rows.size());
  for (const ProbeSample& row : rows) {
    t_s.push_back(1e-9 * static_cast<double>(row.t_ns - origin_ns));
    force.push_back(static_cast<float>(calibration ? calibration->force.force_N(row.force_counts) : row.force_counts));
    const Eigen::Vector3d f =
        calibration ? calibration->accelerometer.specific_force_mps2(row.accel_counts) : row.accel_counts;
    for (int axis = 0; axis < 3; ++axis) accel.push_back(static_cast<float>(f[axis]));
  }
  BlockWriter out("scan.probe");
  out.head()["sequence"] = first_row;
  out.head()["dropped"] = dropped;
  out.head()["origin_ns"] = origin_ns;
  out.head()["newest_ns"] = rows.empty() ? origin_ns : rows.back().t_ns;
  out.head()["calibrated"] = calibration.has_value();
  out.add("t_s", std::span<const double>(t_s));
  out.add("force_N", std::span<const float>(force));
  out.add("accel_mps2", std::span<const float>(accel), {rows.size(), 3});
  return out;
}

BlockWriter image_block(const SeenImage& seen) {
  const SmallImage& small = seen.small;
  BlockWriter out("scan.image");
  out.head()["t_ns"] = small.t_ns;
  out.head()["factor"] = small.factor;
  out.head()["tags"] = Json::array();
  if (const auto& pose = seen.pose) {
    out.head()["reprojection_px"] = number_or_null(pose->sample.reprojection_px);
    out.head()["ambiguous"] = pose->ambiguous;
    for (const TagDetection& tag : pose->tags) {
      Json each;
      each["id"] = tag.id;
      each["corners_px"] = Json::array();
      for (int corner = 0; corner < 4; ++corner) {
        for (int axis = 0; axis < 2; ++axis)
          each["corners_px"].push_back((tag.corners_px(axis, corner) + 0.5) / small.factor - 0.5);
      }
      out.head()["tags"].push_back(std::move(each));
    }
  }
  out.add("pixels", std::span<const std::uint8_t>(small.image.pixels),
          {static_cast<std::size_t>(small.image.height), static_cast<std::size_t>(small.image.width)});
  return out;
}

Json camera_json(const CameraCalibration& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

Json hints_json(const std::vector<Hint>& hints) {
  Json out = Json::array();
  for (const Hint& hint : hints) {
    Json each;
    each["kind"] = kHintKindNames.at(static_cast<std::size_t>(hint.kind));
    each["severity"] = kHintSeverityNames.at(static_cast<std::size_t>(hint.severity));
    each["text"] = hint.text;
    out.push_back(std::move(each));
  }
  return out;
}

Json recorder_json(const RecorderSnapshot& now) {
  Json out;
  out["running_s"] = now.running_s;
  out["probe"] = sensor_json(now.probe);
  out["poses"] = sensor_json(now.poses);
  out["link"] = link_json(now.link);
  out["tracking"] = {
      {"frames", now.tracking.frames}, {"poses", now.tracking.poses}, {"skipped_frames", now.tracking.skipped_frames}};
  out["force_N"] = number_or_null(now.force_N);
  out["force_is_calibrated"] = now.force_is_calibrated;
  out["touching"] = now.touching;
  out["contact_ready"] = now.contact_ready;
  out["touches"] = now.touches;
  out["markers"] = now.pose ? Json(now.pose->markers) : Json();
  out["pose"] = now.pose ? json_of_pose(now.pose->T_world_marker) : Json();
  out["pose_age_s"] = number_or_null(now.pose_age_s);
  for (const BodySnapshot& body : now.bodies) {
    out["bodies"].push_back({{"name", body.name},
                             {"rows", body.rows},
                             {"markers", body.pose ? Json(body.pose->markers) : Json()},
                             {"pose_age_s", number_or_null(body.pose_age_s)}});
  }
  out["storing"] = now.storing;
  out["automatic"] = now.automatic;
  out["segment"] = printable(now.segment, 100);
  out["segments"] = segments_json(now);
  out["discarded"] = now.discarded;
  out["last_discarded"] = now.last_discarded ? segment_json(*now.last_discarded) : Json();
  out["recorded_s"] = now.recorded_s;
  out["probe_rows"] = now.probe_rows;
  out["tracker_rows"] = now.tracker_rows;
  out["disk_bytes"] = now.disk_bytes;
  out["highest_write_s"] = now.highest_write_s;
  out["gravity"] = {{"measured", now.gravity.measured},
                    {"implausible", now.gravity.implausible},
                    {"magnitude_mps2", now.gravity.measured ? Json(now.gravity.gravity_world_mps2.norm()) : Json()}};
  out["columns_missing"] = now.columns_missing;
  out["failure"] = printable(now.failure, 300);
  return out;
}

}  // namespace asperity::studio
