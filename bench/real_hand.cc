// A real hand: inertial samples and motion capture of one body (docs/accuracy.md says whose). The poses are
// thinned to 45 Hz and given the seed's tracker noise; the full-rate poses are the truth. Prints the RMS
// position error of the interpolated poses, of the seed's filter as it is and with the best white
// acceleration of five (erratum 8), and of ours, in Markdown.
//
//   real_hand imu.csv mocap.csv [SEEDS]

#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/signal/statistics.h"

namespace {

asperity::Accuracy accuracy_of(const asperity::Recording& recording, asperity::Method method,
                               double white_acceleration_mps2 = 0.0) {
  asperity::ProcessConfig config;
  config.method = method;
  config.thesis.trajectory.white_acceleration_mps2 = white_acceleration_mps2;
  return *asperity::process_recording(recording, config).accuracy;
}

void run(const char* imu, const char* poses, int seeds) {
  const asperity::ImportInput input = asperity::read_imu_pose(imu, poses);
  std::vector<double> raw, thesis, tuned, fused, ratio, honesty;
  std::printf(
      "| seed | raw poses, mm | thesis, mm | thesis tuned, mm | fused, mm | fused / raw | error / σ "
      "|\n|---|---|---|---|---|---|---|\n");
  for (int seed = 1; seed <= seeds; ++seed) {
    asperity::ImportConfig config;
    config.pose_rate_Hz = 45.0;
    config.pose_noise_m = {0.15e-3, 0.13e-3, 0.54e-3};
    config.seed = seed;
    const asperity::Recording recording = asperity::import_imu_pose(input, config);
    const asperity::Accuracy theirs = accuracy_of(recording, asperity::Method::kThesis);
    const asperity::Accuracy ours = accuracy_of(recording, asperity::Method::kFused);
    double best_m = std::numeric_limits<double>::infinity();
    for (const double white_mps2 : {1.0, 3.0, 10.0, 30.0, 100.0}) {
      best_m = std::min(best_m, accuracy_of(recording, asperity::Method::kThesis, white_mps2).position_rms_m);
    }
    tuned.push_back(1e3 * best_m);
    raw.push_back(1e3 * ours.tracker_rms_m);
    thesis.push_back(1e3 * theirs.position_rms_m);
    fused.push_back(1e3 * ours.position_rms_m);
    ratio.push_back(ours.position_rms_m / ours.tracker_rms_m);
    honesty.push_back(ours.position_error_over_sigma);
    std::printf("| %d | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f |\n", seed, raw.back(), thesis.back(), tuned.back(),
                fused.back(), ratio.back(), honesty.back());
  }
  std::printf("| median | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f |\n", asperity::median(raw), asperity::median(thesis),
              asperity::median(tuned), asperity::median(fused), asperity::median(ratio), asperity::median(honesty));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3 || argc > 4) throw asperity::Error("usage: real_hand imu.csv mocap.csv [SEEDS]");
    const auto seeds = argc > 3 ? asperity::parse_int64(argv[3]) : 5;
    if (!seeds || *seeds < 1 || *seeds > 1000) throw asperity::Error("real_hand: seeds must be from 1 to 1000");
    run(argv[1], argv[2], static_cast<int>(*seeds));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
