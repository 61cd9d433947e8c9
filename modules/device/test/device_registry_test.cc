#include "asperity/device/device_registry.h"

#include <algorithm>
#include <any>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/device/open_haply.h"
#include "asperity/device/open_two_diy.h"

namespace asperity {
namespace {

using testing::ElementsAre;

// As docs/devices.md and the help of `asperity feel` have them.
TEST(DeviceRegistry, HasEachDeviceOnceInOrder) {
  std::vector<std::string> names;
  for (const DeviceKind& kind : device_kinds()) names.emplace_back(kind.name);
  EXPECT_THAT(names, ElementsAre("sim", "replay", "haply", "openhaptics", "dhd", "2diy", "audio", "gamepad"));
  EXPECT_EQ(find_device_kind("mouse"), nullptr);
  EXPECT_EQ(find_device_kind("dhd")->title, "Force Dimension");
}

TEST(DeviceRegistry, KnowsWhoMovesAndFeelsADevice) {
  for (const DeviceKind& kind : device_kinds()) {
    const std::string name(kind.name);
    const bool computed = name == "sim" || name == "replay";
    const bool vibrates = name == "audio" || name == "gamepad";
    EXPECT_EQ(kind.has_person, !computed) << name;
    EXPECT_EQ(kind.vibrotactile, vibrates) << name;
    EXPECT_EQ(kind.driven(), computed || vibrates) << name;
    EXPECT_EQ(kind.mover == DeviceMover::kPath, name == "replay") << name;
    EXPECT_EQ(kind.needs.has_value(), name == "2diy") << name;
  }
}

TEST(DeviceRegistry, ListsTheSettingsOfADeviceUnderItsName) {
  DeviceConfigs configs;
  std::set<std::string> groups;
  const std::vector<ConfigField> fields = list_fields("", configs);
  for (const ConfigField& field : fields) groups.insert(field.path.substr(0, field.path.find('.')));
  EXPECT_THAT(groups, ElementsAre("2diy", "audio", "dhd", "gamepad", "haply", "openhaptics"));
  set_field(fields, "haply.port", "12345");
  EXPECT_EQ(configs.get<HaplyConfig>("haply").port, 12345);
  EXPECT_THROW(configs.get<TwoDiyConfig>("haply"), std::bad_any_cast);
}

TEST(DeviceRegistry, SettingsAreCopiedAsAValue) {
  DeviceConfigs first;
  DeviceConfigs second = first;
  second.get<HaplyConfig>("haply").port = 1;
  EXPECT_EQ(first.get<HaplyConfig>("haply").port, HaplyConfig().port);
}

TEST(DeviceRegistry, SaysWhatADeviceNeeds) {
  DeviceConfigs configs;
  ASSERT_TRUE(configs.missing("2diy"));
  EXPECT_EQ(configs.missing("2diy")->setting, "2diy.port");
  configs.get<TwoDiyConfig>("2diy").port = "/dev/null";
  EXPECT_FALSE(configs.missing("2diy"));
  EXPECT_FALSE(configs.missing("haply"));
  EXPECT_THROW(configs.missing("parrot"), Error);
  // The setting it names is one of its settings.
  const std::vector<ConfigField> fields = list_fields("", configs);
  EXPECT_TRUE(std::any_of(fields.begin(), fields.end(), [](const ConfigField& f) { return f.path == "2diy.port"; }));
}

TEST(DeviceRegistry, OpensWhatIsDrivenAlongItsPath) {
  DeviceDrive drive;
  for (int k = 0; k < 3; ++k) drive.path.push_back({k * 1'000'000LL, {1e-3 * k, 0.0, 0.0}, 0.0});
  const DeviceConfigs configs;
  EXPECT_EQ(configs.open("sim", drive)->info().name, "sim");
  const auto replay = configs.open("replay", drive);
  EXPECT_EQ(replay->info().name, "replay");
  EXPECT_EQ(replay->read(1'000'000).p_m.x(), 1e-3);
  EXPECT_THROW(configs.open("2diy", drive), Error);
  EXPECT_THROW(configs.open("parrot", drive), Error);
}

}  // namespace
}  // namespace asperity
