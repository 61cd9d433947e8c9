#include <atomic>
#include <filesystem>

#include <unistd.h>

#include "../second_bench/second_scan.h"
#include "asperity/base/error.h"
#include "asperity/recording/read_recording.h"
#include "scan_case.h"

namespace bench {

namespace {

// A folder of its own that goes with it.
class ScratchFolder {
 public:
  ScratchFolder() {
    static std::atomic<int> next{0};
    path_ = std::filesystem::temp_directory_path() /
            ("coverage-" + std::to_string(::getpid()) + "-" + std::to_string(next++));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class T>
T pick(const std::vector<T>& list, std::uint64_t seed) {
  return list.empty() ? T{} : list[seed % list.size()];
}

}  // namespace

ScanCase simulate_second_case(std::uint64_t seed, const CaseChoice& choice) {
  const std::string family = pick(choice.families, seed);
  const std::string probe = pick(choice.probes, choice.families.empty() ? seed : seed / choice.families.size());
  second_bench::ScanPlan plan;
  try {
    plan = second_bench::draw_plan(seed, family, probe);
  } catch (const std::invalid_argument& error) {
    throw asperity::Error(error.what());
  }
  if (choice.exact_calibration) {
    plan.accel_scale_error = plan.accel_offset_error_mps2 = plan.gyro_scale_error = plan.gyro_offset_error_radps = 0.0;
    plan.force_scale_error = plan.force_offset_error_N = plan.tip_error_m = plan.sensor_place_error_m = 0.0;
    plan.latency_error_s = plan.gravity_error_rad = plan.sigma_error = 0.0;
  }
  const ScratchFolder folder;
  second_bench::write_scan(plan, folder.path());
  ScanCase out;
  out.seed = seed;
  out.family = plan.family;
  out.probe = plan.open ? "open" : "what";
  const auto note = [&](bool has, const char* name) {
    if (has) out.conditions.emplace_back(name);
  };
  note(plan.batch_s > 0.0, "batches");
  note(plan.rest_middle_s > 0.0, "static intervals in the stroke");
  note(plan.rest_before_s > 1.5, "long static intervals");
  note(plan.approach_s > 0.0, "approach through the air");
  note(plan.slow_share > 0.3, "tracker drift");
  note(plan.radius_m > 0.0, "on a cylinder");
  note(plan.force_to_N != plan.force_from_N, "rising force");
  note(plan.states_frame_sigmas, "sigma per frame");
  out.recording = asperity::read_recording(folder.path());
  out.nothing = plan.family == "air" || plan.family == "glass";
  if (plan.family != "steps") out.pitch_m = plan.pitch_m;
  if (plan.family != "air") out.stiffness_N_per_mm = second_bench::tangent_stiffness_N_per_mm(plan);
  return out;
}

}  // namespace bench
