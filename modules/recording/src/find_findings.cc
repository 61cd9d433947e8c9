#include "find_findings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace asperity {

namespace {

using Findings = std::vector<std::string>;

void judge_timing(const char* stream, const StreamTiming& timing, double nominal_Hz, const InspectConfig& config,
                  Findings& out) {
  if (timing.count < 2) {
    out.push_back(fmt::format("The {} has a single row.", stream));
    return;
  }
  const double rate_Hz = 1.0 / timing.period_s;
  if (nominal_Hz > 0.0 && std::abs(rate_Hz / nominal_Hz - 1.0) > config.rate_tolerance) {
    out.push_back(
        fmt::format("The {} runs at {:.4g} Hz where its nominal rate is {:.4g} Hz.", stream, rate_Hz, nominal_Hz));
  }
  if (timing.lost_share > config.lost_tolerance) {
    out.push_back(fmt::format("The {} lost about {} rows ({:.1f} %).", stream, timing.lost, 100.0 * timing.lost_share));
  }
  if (timing.longest_gap_s > config.gap_tolerance_s) {
    out.push_back(fmt::format("The {}'s longest gap is {:.3g} s.", stream, timing.longest_gap_s));
  }
}

void judge_overlap(const Inspection& inspection, Findings& out) {
  constexpr double kEnough = 0.9;
  const double shorter_s = std::min(inspection.probe.duration_s, inspection.tracker.duration_s);
  if (inspection.overlap_s <= 0.0) {
    out.emplace_back("Probe and tracker do not overlap in time: their clocks differ, or one of them is missing.");
  } else if (inspection.overlap_s < kEnough * shorter_s) {
    out.push_back(fmt::format("Probe and tracker overlap for {:.3g} s only; the shorter of them lasts {:.3g} s.",
                              inspection.overlap_s, shorter_s));
  }
}

void judge_channels(const Recording& recording, const Inspection& inspection, const InspectConfig& config,
                    Findings& out) {
  for (const auto& channel : inspection.channels) {
    if (channel.name == "force" && !recording.info.has_force_sensor) continue;
    if (channel.samples == 0) {
      out.push_back(fmt::format("{} has no samples.", channel.name));
    } else if (channel.samples > 1 && channel.lowest == channel.highest) {
      out.push_back(fmt::format("{} never changes: it reads {:g} throughout.", channel.name, channel.lowest));
    } else if (channel.saturated_share > config.saturation_tolerance) {
      out.push_back(fmt::format("{} is at the end of its range in {:.2f} % of its samples.", channel.name,
                                100.0 * channel.saturated_share));
    }
  }
}

void judge_gravity(const Recording& recording, const QuietInterval& quiet, const InspectConfig& config, Findings& out) {
  const double gravity_mps2 = recording.info.gravity_world_mps2.norm();
  if (std::abs(quiet.gravity_mps2 - gravity_mps2) > config.gravity_tolerance * gravity_mps2) {
    out.push_back(fmt::format(
        "The stationary accelerometer reads {:.3f} m/s² where gravity is {:.3f} m/s²: its calibration does not fit.",
        quiet.gravity_mps2, gravity_mps2));
  }
  if (quiet.gravity_angle_rad > config.gravity_angle_tolerance_rad) {
    out.push_back(
        fmt::format("The up direction of the stationary accelerometer is {:.1f}° from the world's: gravity_world_mps2, "
                    "the pose or the accelerometer's rotation is wrong.",
                    quiet.gravity_angle_rad * 180.0 / std::numbers::pi));
  }
}

void judge_quiet_interval(const Recording& recording, const Inspection& inspection, const InspectConfig& config,
                          Findings& out) {
  if (!inspection.quiet) {
    out.push_back(fmt::format("No stretch of {:g} s is without a gap: noise was not measured.", config.quiet_s));
    return;
  }
  const QuietInterval& quiet = *inspection.quiet;
  if (!quiet.at_rest) {
    out.push_back(
        fmt::format("The probe is never stationary for {:g} s; hold it still at the start to check its calibration.",
                    config.quiet_s));
    return;
  }
  judge_gravity(recording, quiet, config, out);
  constexpr double kWorse = 3.0;
  const Eigen::Vector3d& sigma_m = recording.calibration.tracker.sigma_position_m;
  if ((quiet.position_noise_m.array() > kWorse * sigma_m.array()).any()) {
    out.push_back(
        fmt::format("The noise of the stationary tracker is ({:.3f}, {:.3f}, {:.3f}) mm; its calibration states "
                    "({:.3f}, {:.3f}, {:.3f}) mm.",
                    1e3 * quiet.position_noise_m.x(), 1e3 * quiet.position_noise_m.y(),
                    1e3 * quiet.position_noise_m.z(), 1e3 * sigma_m.x(), 1e3 * sigma_m.y(), 1e3 * sigma_m.z()));
  }
}

}  // namespace

Findings find_findings(const Recording& recording, const Inspection& inspection, const InspectConfig& config) {
  Findings out;
  judge_timing("probe", inspection.probe, recording.info.probe_rate_Hz, config, out);
  judge_timing("tracker", inspection.tracker, recording.info.tracker_rate_Hz, config, out);
  judge_overlap(inspection, out);
  judge_channels(recording, inspection, config, out);
  judge_quiet_interval(recording, inspection, config, out);
  if (inspection.flips > 0) {
    out.push_back(fmt::format("{} far from {} neighbours, as when the mirrored tilt of a marker is taken for its tilt.",
                              inspection.flips == 1 ? "1 pose is" : fmt::format("{} poses are", inspection.flips),
                              inspection.flips == 1 ? "its" : "their"));
  }
  const double allowed_N = std::max(0.2, 5.0 * recording.calibration.force.residual_newton);
  if (inspection.force_lowest_N < -allowed_N) {
    out.push_back(fmt::format("The force goes down to {:.2f} N: its offset is wrong.", inspection.force_lowest_N));
  }
  return out;
}

}  // namespace asperity
