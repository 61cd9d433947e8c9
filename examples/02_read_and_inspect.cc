// Reads a recording, says what looks wrong with it, and shows its first samples in SI units.
//
//   02_read_and_inspect REC          REC: a folder, as `asperity simulate -o REC` makes one

#include <algorithm>
#include <cstdio>
#include <exception>

#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/read_recording.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s REC\n", argv[0]);
    return 2;
  }
  // Throws asperity::Error for what cannot be used; what was repaired or left out is in `problems`.
  const asperity::Recording recording = asperity::read_recording(argv[1]);
  for (const asperity::Problem& problem : recording.problems) {
    std::printf("%s (%zu): %s\n", problem.kind.c_str(), problem.count, problem.message.c_str());
  }

  const asperity::Inspection inspection = asperity::inspect_recording(recording);
  std::printf("probe    %zu rows at %.1f Hz, %.2f %% lost\n", inspection.probe.count, inspection.probe.mean_rate_Hz,
              100.0 * inspection.probe.lost_share);
  std::printf("tracker  %zu poses at %.1f Hz, %.2f %% lost, %zu flips\n", inspection.tracker.count,
              inspection.tracker.mean_rate_Hz, 100.0 * inspection.tracker.lost_share, inspection.flips);
  for (const auto& finding : inspection.findings) std::printf("finding  %s\n", finding.c_str());

  // Streams are arrays in raw counts; the calibration turns them into SI units.
  const asperity::Calibration& calibration = recording.calibration;
  std::printf("\n%12s %10s %10s %10s\n", "t, s", "fx, m/s2", "fy, m/s2", "fz, m/s2");
  const std::size_t shown = std::min<std::size_t>(recording.probe.size(), 5);
  for (std::size_t i = 0; i < shown; ++i) {
    const Eigen::Vector3d f_mps2 = calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[i]);
    const double t_s = 1e-9 * static_cast<double>(recording.probe.t_ns[i] - recording.probe.t_ns.front());
    std::printf("%12.6f %10.4f %10.4f %10.4f\n", t_s, f_mps2.x(), f_mps2.y(), f_mps2.z());
  }
  // The tip as the raw tracker saw it.
  const Eigen::Vector3d p_world_tip_m = recording.tracker.T_world_marker.front() * calibration.tip_in_marker_m;
  std::printf("tip at the first pose: %.4f %.4f %.4f m\n", p_world_tip_m.x(), p_world_tip_m.y(), p_world_tip_m.z());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
