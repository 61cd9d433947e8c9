// A device, as docs/architecture.md tells to add one. Its line in device_registry.cc is in CMakeLists.txt here.
#include <gmock/gmock.h>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/device/device_registry.h"
#include "asperity/session/feel_device.h"
#include "metronome_device.h"

namespace asperity {
namespace {

// modules/device/src/metronome_device.cc -----------------------------------------------------------------------------

class MetronomeDevice : public HapticDevice {
 public:
  explicit MetronomeDevice(const MetronomeConfig& config) : config_(config) {
    info_.name = "metronome";
    info_.model = "metronome";
    info_.yields = false;
  }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    const double rate = 2.0 * std::numbers::pi / config_.period_s;
    const double phase = rate * 1e-9 * static_cast<double>(t_ns);
    DeviceReading out;
    out.p_m.y() = config_.amplitude_m * std::cos(phase);
    out.v_mps.y() = -config_.amplitude_m * rate * std::sin(phase);
    out.sequence = ++sequence_;
    out.status = closed_ ? DeviceStatus::kEnded : DeviceStatus::kReady;
    return out;
  }

  void write(const Eigen::Vector3d&) noexcept override {}
  void close() noexcept override { closed_ = true; }
  std::string fault() const override { return ""; }

 private:
  MetronomeConfig config_;
  DeviceInfo info_;
  std::uint64_t sequence_ = 0;
  bool closed_ = false;
};

}  // namespace

std::unique_ptr<HapticDevice> open_metronome(const MetronomeConfig& config) {
  if (!(config.period_s > 0.0)) throw Error("metronome: its period is not positive");
  return std::make_unique<MetronomeDevice>(config);
}

namespace {

// --------------------------------------------------------------------------------------------------------------------

TEST(AddingADevice, ItIsAmongTheDevicesWithItsTitleAndSettings) {
  const DeviceKind* kind = find_device_kind("metronome");
  ASSERT_NE(kind, nullptr);
  EXPECT_EQ(kind->title, "Metronome");
  EXPECT_EQ(&device_kinds().back(), kind);
  EXPECT_NE(find_device_kind("haply"), nullptr);

  FeelSettings settings;
  std::vector<std::string> paths;
  for (const ConfigField& field : feel_fields(settings)) paths.push_back(field.path);
  EXPECT_THAT(paths, testing::Contains("metronome.period_s"));
  EXPECT_THAT(paths, testing::Contains("haply.port"));
}

TEST(AddingADevice, ItIsOpenedByItsNameWithItsSettings) {
  FeelSettings settings;
  set_field(feel_fields(settings), "metronome.period_s", "2");
  const std::unique_ptr<HapticDevice> device = open_device("metronome", {}, settings);
  EXPECT_EQ(device->info().name, "metronome");
  EXPECT_NEAR(device->read(0).p_m.y(), 0.01, 1e-15);
  EXPECT_NEAR(device->read(1'000'000'000).p_m.y(), -0.01, 1e-15);
  EXPECT_THROW(set_field(feel_fields(settings), "metronome.period_s", "0"), Error);
}

}  // namespace
}  // namespace asperity
