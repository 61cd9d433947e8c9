#include "feel/feel_setup.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/device/open_two_diy.h"
#include "asperity/testkit/temp_dir.h"
#include "feel/feel_devices.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

std::string refusal(const Json& section) {
  try {
    read_feel_choices(section);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Json with(const char* key, Json value) {
  Json section = first_feel_section();
  section[key] = std::move(value);
  return section;
}

}  // namespace

TEST(FeelChoices, AreWhatTheSectionSays) {
  const FeelChoices first = read_feel_choices(first_feel_section());
  EXPECT_TRUE(first.empty());
  EXPECT_EQ(first.device, "mouse");
  EXPECT_FALSE(first.max_force_N);

  Json section = with("height_maps", {"a.png", "b.png"});
  section["max_force_N"] = 1.5;
  section["textures"]["3"] = "wood.texture.json";
  section["settings"]["render.friction"] = 0.25;
  section["settings"]["render.texture.model"] = "stochastic";
  const FeelChoices chosen = read_feel_choices(section);
  EXPECT_EQ(chosen.height_maps, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_EQ(chosen.max_force_N, 1.5);
  EXPECT_EQ(chosen.textures.at(3), "wood.texture.json");
  EXPECT_EQ(chosen.settings.at("render.friction"), "0.25");
  EXPECT_EQ(chosen.settings.at("render.texture.model"), "\"stochastic\"");
}

TEST(FeelChoices, RefuseWhatIsNone) {
  EXPECT_THAT(refusal(with("library", "/opt/x.so")), HasSubstr("feel.library"));
  EXPECT_THAT(refusal(with("scene", 3)), HasSubstr("feel.scene"));
  EXPECT_THAT(refusal(with("scene", std::string(2000, 'a'))), HasSubstr("too long"));
  EXPECT_THAT(refusal(with("tile_mm", -1.0)), HasSubstr("feel.tile_mm"));
  EXPECT_THAT(refusal(with("mapped", 1)), HasSubstr("feel.mapped"));
  EXPECT_THAT(refusal(with("max_force_N", -0.1)), HasSubstr("feel.max_force_N"));
  EXPECT_THAT(refusal(with("textures", {{"1x", "a"}})), HasSubstr("1x"));
  EXPECT_THAT(refusal(with("settings", {{"render.friction", Json::object()}})), HasSubstr("render.friction"));
  EXPECT_THAT(refusal(with("height_maps", Json(std::vector<std::string>(300, "a")))), HasSubstr("height_maps"));
  Json both = with("scene", "a.obj");
  both["height_maps"] = {"a.png"};
  EXPECT_THAT(refusal(both), HasSubstr("either a scene or height maps"));
  EXPECT_NE(refusal(Json(3)), "");
}

// What a browser may change must not reach hardware, files or limits.
TEST(FeelSetup, ABrowserSetsNoPortsDriversNorLimits) {
  FeelConfig config;
  const std::vector<ConfigField> fields = settable_fields(config);
  const auto has = [&](const std::string& path) {
    return std::any_of(fields.begin(), fields.end(), [&](const ConfigField& field) { return field.path == path; });
  };
  EXPECT_TRUE(has("render.stiffness_N_per_m"));
  EXPECT_TRUE(has("pointer.stiffness_N_per_m"));
  EXPECT_TRUE(has("stroke.press_N"));
  for (const ConfigField& field : fields) {
    EXPECT_NE(field.type, FieldType::kText) << field.path;
    for (const char* part : {"safety", "library", "host", "port", "device", "driver", "caps"}) {
      const bool frame = field.path == "servo.frame.R_world_device_xyzw";
      EXPECT_TRUE(frame || field.path.find(part) == std::string::npos) << field.path;
    }
  }
  testkit::TempDir folder;
  std::ofstream(folder / "plate.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Project project(folder.path());
  for (const char* path : {"openhaptics.library", "dhd.library", "haply.host", "2diy.port", "safety.max_force_N",
                           "safety.passivity", "caps.texture_stiffness_N_per_m_kHz", "servo.paced"}) {
    FeelChoices choices;
    choices.scene = "plate.obj";
    choices.settings[path] = "1";
    EXPECT_THROW(resolve_choices(choices, {}, project), Error) << path;
  }
}

TEST(FeelSetup, FilesStayInTheProject) {
  testkit::TempDir folder;
  std::filesystem::create_directory(folder / "project");
  std::ofstream(folder / "outside.obj") << "v 0 0 0\n";
  std::ofstream(folder / "project/inside.obj") << "v 0 0 0\n";
  const Project project(folder / "project");
  FeelChoices choices;
  choices.scene = "inside.obj";
  EXPECT_NO_THROW(resolve_choices(choices, {}, project));
  choices.replay = "../outside.obj";
  EXPECT_THROW(resolve_choices(choices, {}, project), Error);
  choices.replay.clear();
  choices.textures[1] = "/etc/passwd";
  EXPECT_THROW(resolve_choices(choices, {}, project), Error);
  choices.textures.clear();
  choices.scene = "../outside.obj";
  EXPECT_THROW(resolve_choices(choices, {}, project), Error);
  // A folder is inside; its scene may be a link that leads out.
  std::ofstream(folder / "scene.json") << "{}";
  std::filesystem::create_directory(folder / "project/linked");
  std::filesystem::create_symlink(folder / "scene.json", folder / "project/linked/scene.json");
  choices.scene = "linked";
  EXPECT_THROW(resolve_choices(choices, {}, project), Error);
  std::filesystem::create_directory(folder / "project/own");
  std::ofstream(folder / "project/own/scene.json") << "{}";
  choices.scene = "own";
  EXPECT_NO_THROW(resolve_choices(choices, {}, project));
}

TEST(FeelDevices, SayWhatTheyLack) {
  FeelConfig start;
  const auto of = [&](const char* name) {
    for (const Json& device : feel_devices_json(start)) {
      if (device["name"] == name) return device;
    }
    return Json();
  };
  EXPECT_EQ(of("mouse")["available"], true);
  EXPECT_EQ(of("2diy")["available"], false);
  EXPECT_THAT(of("2diy")["words"].get<std::string>(), HasSubstr("port"));
  start.feel.devices.get<TwoDiyConfig>("2diy").port = "/dev/ttyACM0";
  EXPECT_EQ(of("2diy")["available"], true);
  EXPECT_THROW(feel_device_kind("parrot"), Error);
}

}  // namespace asperity::studio
