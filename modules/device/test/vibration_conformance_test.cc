#include <algorithm>

#include "asperity/device/open_audio_sink.h"
#include "asperity/device/open_rumble_sink.h"
#include "asperity/device/open_vibrating.h"
#include "asperity/device/sim_device.h"
#include "asperity/testkit/temp_dir.h"
#include "conformance.h"
#include "disk_audio.h"
#include "virtual_gamepad.h"

namespace asperity::testing_devices {

namespace {

// A hand that hangs still, to go with a sink.
std::unique_ptr<HapticDevice> open_hand() {
  return open_sim({}, {{0, Eigen::Vector3d::Zero(), 0.0}, {100'000'000'000, Eigen::Vector3d::Zero(), 0.0}});
}

class AudioRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override {
    AudioSinkConfig config;
    config.driver = "disk";
    config.block_samples = DiskAudio::kBlock;
    return open_vibrating(open_hand(), open_audio_sink(config));
  }
  // The loudest sample since the last call, of at least one block: the driver's file is written in pieces.
  Eigen::Vector3d motor_output() override {
    const std::vector<double> sound = disk_.samples();
    if (sound.size() < heard_) heard_ = 0;
    const std::size_t block = std::min<std::size_t>(sound.size(), DiskAudio::kBlock);
    double most = 0.0;
    for (std::size_t i = std::min(heard_, sound.size() - block); i < sound.size(); ++i) {
      most = std::max(most, std::abs(sound[i]));
    }
    heard_ = sound.size();
    return {most, 0.0, 0.0};
  }
  bool has_position() const override { return false; }
  bool exclusive() const override { return false; }
  bool can_unplug() const override { return false; }
  bool can_stall() const override { return false; }

 private:
  testkit::TempDir folder_;
  DiskAudio disk_{folder_ / "sound.raw"};
  std::size_t heard_ = 0;
};

class GamepadRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override { return open_vibrating(open_hand(), open_rumble_sink({})); }
  Eigen::Vector3d motor_output() override { return {pad_.now().low + pad_.now().high, 0.0, 0.0}; }
  bool has_position() const override { return false; }
  bool exclusive() const override { return false; }
  bool can_stall() const override { return false; }
  void unplug() override { pad_.unplug(); }

 private:
  VirtualGamepad pad_{"Test Pad"};
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Vibration, DeviceConformance,
                         testing::Values(ConformanceCase{"audio", [] { return std::make_unique<AudioRig>(); }},
                                         ConformanceCase{"gamepad", [] { return std::make_unique<GamepadRig>(); }}),
                         case_name);

}  // namespace asperity::testing_devices
