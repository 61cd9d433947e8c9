// A real hand: inertial samples and motion capture of one body (docs/accuracy.md says whose). The poses are
// thinned to 45 Hz and given the seed's tracker noise; the full-rate poses are the truth. Prints the RMS
// position error of the interpolated poses, of the seed's filter and of ours, in Markdown.
//
//   real_hand imu.csv mocap.csv [SEEDS]

#include <cstdio>
#include <exception>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/import.h"
#include "asperity/signal/statistics.h"

namespace {

double position_rms_mm(const asperity::Recording& recording, asperity::Method method, double& tracker_mm) {
  asperity::ProcessConfig config;
  config.method = method;
  const asperity::ProcessResult result = asperity::process_recording(recording, config);
  tracker_mm = 1e3 * result.accuracy->tracker_rms_m;
  return 1e3 * result.accuracy->position_rms_m;
}

void run(const char* imu, const char* poses, int seeds) {
  const asperity::ImportInput input = asperity::read_imu_pose(imu, poses);
  std::vector<double> raw, thesis, fused, ratio;
  std::printf("| seed | raw poses, mm | thesis, mm | fused, mm | fused / raw |\n|---|---|---|---|---|\n");
  for (int seed = 1; seed <= seeds; ++seed) {
    asperity::ImportConfig config;
    config.pose_rate_Hz = 45.0;
    config.pose_noise_m = {0.15e-3, 0.13e-3, 0.54e-3};
    config.seed = seed;
    const asperity::Recording recording = asperity::import_imu_pose(input, config);
    double tracker_mm = 0.0;
    thesis.push_back(position_rms_mm(recording, asperity::Method::kThesis, tracker_mm));
    fused.push_back(position_rms_mm(recording, asperity::Method::kFused, tracker_mm));
    raw.push_back(tracker_mm);
    ratio.push_back(fused.back() / tracker_mm);
    std::printf("| %d | %.3f | %.3f | %.3f | %.3f |\n", seed, raw.back(), thesis.back(), fused.back(), ratio.back());
  }
  std::printf("| median | %.3f | %.3f | %.3f | %.3f |\n", asperity::median(raw), asperity::median(thesis),
              asperity::median(fused), asperity::median(ratio));
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
