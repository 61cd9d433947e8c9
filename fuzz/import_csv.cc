// Two files in one input, parted by a line "%%%": imu.csv and mocap.csv.
#include "asperity/base/error.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/validate_recording.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kMark = "%%%\n";
  const std::string_view text = fuzz_text(data, size);
  const auto middle = text.find(kMark);
  ImportInput input;
  try {
    parse_imu_csv(text.substr(0, middle), "imu.csv", input);
    parse_pose_csv(middle == std::string_view::npos ? "" : text.substr(middle + kMark.size()), "mocap.csv", input);
  } catch (const Error&) {
    return 0;
  }
  ImportConfig config;
  config.pose_rate_Hz = 45.0;
  config.pose_noise_m = {0.15e-3, 0.13e-3, 0.54e-3};
  validate_recording(import_imu_pose(input, config));
  return 0;
}
