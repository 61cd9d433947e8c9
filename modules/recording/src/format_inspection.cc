#include <cmath>

#include <fmt/format.h>

#include "asperity/json/json.h"
#include "asperity/recording/inspect_recording.h"

namespace asperity {

namespace {

Json vector(const Eigen::Vector3d& v) {
  return Json::array({number_or_null(v.x()), number_or_null(v.y()), number_or_null(v.z())});
}

Json timing_json(const StreamTiming& timing) {
  return {{"rows", timing.count},
          {"start_ns", timing.start_ns},
          {"end_ns", timing.end_ns},
          {"duration_s", number_or_null(timing.duration_s)},
          {"median_rate_hz", number_or_null(timing.median_rate_Hz)},
          {"mean_rate_hz", number_or_null(timing.mean_rate_Hz)},
          {"jitter_s", number_or_null(timing.jitter_s)},
          {"clock_step_ns", timing.clock_step_ns},
          {"gaps", timing.gaps},
          {"longest_gap_s", number_or_null(timing.longest_gap_s)},
          {"lost", timing.lost},
          {"lost_share", number_or_null(timing.lost_share)},
          {"duplicates", timing.duplicates}};
}

Json quiet_json(const QuietInterval& quiet) {
  return {{"start_s", number_or_null(quiet.start_s)},
          {"duration_s", number_or_null(quiet.duration_s)},
          {"at_rest", quiet.at_rest},
          {"specific_force_mps2", vector(quiet.specific_force_mps2)},
          {"acceleration_noise_mps2", vector(quiet.acceleration_noise_mps2)},
          {"gravity_mps2", number_or_null(quiet.gravity_mps2)},
          {"gravity_angle_rad", number_or_null(quiet.gravity_angle_rad)},
          {"force_N", number_or_null(quiet.force_N)},
          {"poses", quiet.poses},
          {"position_noise_m", vector(quiet.position_noise_m)},
          {"rotation_noise_rad", vector(quiet.rotation_noise_rad)}};
}

// A value to so many decimals; a word where there is none.
std::string shown(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "unknown";
}

std::string shown_significant(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "unknown";
}

std::string shown_vector(const Eigen::Vector3d& value, int decimals) {
  return fmt::format("({}, {}, {})", shown(value.x(), decimals), shown(value.y(), decimals),
                     shown(value.z(), decimals));
}

std::string timing_text(const char* stream, const StreamTiming& timing) {
  return fmt::format(
      "{:<8} {} rows over {} s, {} Hz (median {}), jitter {} µs, {} gaps (longest {} ms), {} lost ({} %), {} "
      "duplicates\n",
      stream, timing.count, shown(timing.duration_s, 3), shown(timing.mean_rate_Hz, 2), shown(timing.median_rate_Hz, 2),
      shown(1e6 * timing.jitter_s, 1), timing.gaps, shown(1e3 * timing.longest_gap_s, 1), timing.lost,
      shown(100.0 * timing.lost_share, 2), timing.duplicates);
}

}  // namespace

Json inspection_json(const Inspection& inspection) {
  Json channels = Json::array();
  for (const auto& channel : inspection.channels) {
    channels.push_back({{"name", channel.name},
                        {"samples", channel.samples},
                        {"lowest", number_or_null(channel.lowest)},
                        {"highest", number_or_null(channel.highest)},
                        {"saturated_share", number_or_null(channel.saturated_share)},
                        {"quiet_mean", number_or_null(channel.quiet_mean)},
                        {"quiet_noise", number_or_null(channel.quiet_noise)}});
  }
  return {{"probe", timing_json(inspection.probe)},
          {"tracker", timing_json(inspection.tracker)},
          {"overlap_s", number_or_null(inspection.overlap_s)},
          {"channels", channels},
          {"quiet", inspection.quiet ? quiet_json(*inspection.quiet) : Json()},
          {"force_lowest_N", number_or_null(inspection.force_lowest_N)},
          {"force_highest_N", number_or_null(inspection.force_highest_N)},
          {"force_rate_hz", number_or_null(inspection.force_rate_Hz)},
          {"flips", inspection.flips},
          {"findings", inspection.findings}};
}

std::string inspection_text(const Inspection& inspection) {
  std::string out = timing_text("probe", inspection.probe) + timing_text("tracker", inspection.tracker);
  out += fmt::format("overlap  {} s\n", shown(inspection.overlap_s, 3));
  out += fmt::format("force    {} to {} N at {} Hz\n", shown(inspection.force_lowest_N, 3),
                     shown(inspection.force_highest_N, 3), shown(inspection.force_rate_Hz, 1));
  out += fmt::format("flips    {}\n\n", inspection.flips);
  out += fmt::format("{:<9}{:>12}{:>12}{:>12}{:>12}{:>14}\n", "counts", "lowest", "highest", "quiet mean",
                     "quiet noise", "saturated");
  for (const auto& channel : inspection.channels) {
    const std::string saturated =
        std::isnan(channel.saturated_share) ? "unknown" : fmt::format("{:.3f} %", 100.0 * channel.saturated_share);
    out += fmt::format("{:<9}{:>12}{:>12}{:>12}{:>12}{:>14}\n", channel.name, shown_significant(channel.lowest, 6),
                       shown_significant(channel.highest, 6), shown_significant(channel.quiet_mean, 6),
                       shown_significant(channel.quiet_noise, 4), saturated);
  }
  if (inspection.quiet) {
    const QuietInterval& quiet = *inspection.quiet;
    out += fmt::format("\nquietest {:.2f} s from {:.2f} s: {}\n", quiet.duration_s, quiet.start_s,
                       quiet.at_rest ? "stationary" : "not stationary");
    out += fmt::format("  specific force {} m/s², noise {} m/s², force {} N\n", shown(quiet.gravity_mps2, 4),
                       shown_vector(quiet.acceleration_noise_mps2, 4), shown(quiet.force_N, 3));
    out += fmt::format("  tracker noise {} mm, {} mrad over {} poses\n", shown_vector(1e3 * quiet.position_noise_m, 3),
                       shown_vector(1e3 * quiet.rotation_noise_rad, 2), quiet.poses);
  }
  out += inspection.findings.empty() ? "\nNothing looks wrong.\n" : "\nWhat looks wrong:\n";
  for (const auto& finding : inspection.findings) out += "  - " + finding + "\n";
  return out;
}

}  // namespace asperity
