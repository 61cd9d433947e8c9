#include "add/add_page.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "add/addition.h"
#include "asperity/base/base64.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/read_recording.h"
#include "asperity/texture/texture_file.h"
#include "page_rig.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

class AddPageTest : public ::testing::Test, protected PageRig<> {
 protected:
  AddPageTest() { open(make_add_page(shared)); }

  FakeHub::Answer begin_addition(const std::vector<std::pair<std::string, std::string>>& files) {
    Json list = Json::array();
    for (const auto& [path, bytes] : files) list.push_back({{"path", path}, {"bytes", bytes.size()}});
    return call("add.begin", Json{{"files", list}});
  }
  FakeHub::Answer send(std::int64_t addition, int file, std::size_t at, std::string_view bytes,
                       ClientId client = kClient) {
    return call("add.bytes", Json{{"addition", addition}, {"file", file}, {"at", at}, {"base64", base64(bytes)}},
                client);
  }
  FakeHub::Answer finish(std::int64_t addition) { return call("add.end", Json{{"addition", addition}}); }

  static std::int64_t number(const FakeHub::Answer& answer) {
    EXPECT_EQ(answer.error, "");
    return answer.result["addition"].get<std::int64_t>();
  }
};

TEST_F(AddPageTest, FilesAndFoldersArriveWholeUnderTheirNames) {
  const std::string binary("\0\xFF\n\r\x80z", 6);
  const std::int64_t addition =
      number(begin_addition({{"a.csv", "12345"}, {"scan/deep/b.bin", binary}, {"scan/empty", ""}}));
  EXPECT_EQ(send(addition, 0, 0, "123").error, "");
  EXPECT_FALSE(fs::exists(folder / "a.csv")) << "before all is there nothing is seen";
  EXPECT_TRUE(project.entries().empty());
  EXPECT_EQ(send(addition, 0, 3, "45").error, "");
  EXPECT_EQ(send(addition, 1, 0, binary).error, "");
  const FakeHub::Answer answer = finish(addition);
  ASSERT_EQ(answer.error, "");
  EXPECT_EQ(answer.result["placed"].dump(), R"([{"from":"a.csv","name":"a.csv"},{"from":"scan","name":"scan"}])");
  EXPECT_EQ(content(folder / "a.csv"), "12345");
  EXPECT_EQ(content(folder / "scan/deep/b.bin"), binary);
  EXPECT_EQ(fs::file_size(folder / "scan/empty"), 0U);
  EXPECT_TRUE(wait([&] {
    return names_in(folder.path()) == std::vector<std::string>({"a.csv", "scan"});
  })) << "the hidden folder is gone";
}

TEST_F(AddPageTest, WhatIsThereIsNeverReplaced) {
  std::ofstream(folder / "mesh.obj") << "mine";
  fs::create_directory(folder / "scan");
  const std::int64_t addition = number(begin_addition({{"mesh.obj", "x"}, {"scan/a", "y"}}));
  EXPECT_EQ(send(addition, 0, 0, "x").error, "");
  EXPECT_EQ(send(addition, 1, 0, "y").error, "");
  EXPECT_EQ(finish(addition).result["placed"].dump(),
            R"([{"from":"mesh.obj","name":"mesh_2.obj"},{"from":"scan","name":"scan_2"}])");
  EXPECT_EQ(content(folder / "mesh.obj"), "mine");
  EXPECT_EQ(content(folder / "mesh_2.obj"), "x");
  EXPECT_EQ(content(folder / "scan_2/a"), "y");
}

TEST_F(AddPageTest, PathsThatLeadElsewhereAreRefusedAndNothingIsMade) {
  const std::string long_part(256, 'a');
  const std::vector<std::pair<std::string, const char*>> cases{
      {"../a", "not a path inside"},  {"/etc/a", "not a path inside"}, {"a/../../b", "not a path inside"},
      {"a\\b", "not a path inside"},  {".hidden", "hidden"},           {"a/.asperity-studio.json", "hidden"},
      {"a\nb", "cannot be shown"},    {"a\xff", "cannot be shown"},    {"", "not a path inside"},
      {long_part, "longer than 255"}, {"1/2/3/4/5/6/7/8/9", "deep"},   {"a\x1b[31m", "cannot be shown"},
  };
  for (const auto& [path, why] : cases) {
    EXPECT_THROW(
        {
          try {
            check_added_files({{path, 1}});
          } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(why)) << path;
            throw;
          }
        },
        Error);
  }
  EXPECT_THAT(begin_addition({{"../a", "x"}}).error, HasSubstr("../a"));
  EXPECT_THAT(begin_addition({{"a", "x"}, {"A", "y"}}).error, HasSubstr("twice"));
  EXPECT_THAT(begin_addition({{"a", "x"}, {"a/b", "y"}}).error, HasSubstr("a file and a folder"));
  EXPECT_THAT(begin_addition({}).error, HasSubstr("no file"));
  for (const char* files : {R"({})", R"({"files":3})", R"({"files":[{"path":1,"bytes":1}]})",
                            R"({"files":[{"path":"a","bytes":-1}]})", R"({"files":[{"path":"a","bytes":1e300}]})"}) {
    EXPECT_NE(call("add.begin", parse_json(files)).error, "") << files;
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST_F(AddPageTest, BoundsWhatOneAdditionBrings) {
  EXPECT_THROW(check_added_files(std::vector<AddedFile>(kMostAddedFiles + 1, {"a", 0})), Error);
  EXPECT_THROW(check_added_files({{"a", kMostAddedBytes}, {"b", 1}}), Error);
  EXPECT_THROW(check_added_files({{"a", ~std::uint64_t{0}}, {"b", ~std::uint64_t{0}}}), Error);
  EXPECT_NO_THROW(check_added_files({{"a", kMostAddedBytes}}));
  std::vector<std::int64_t> open;
  for (int i = 0; i < 8; ++i) open.push_back(number(begin_addition({{"f", "x"}})));
  EXPECT_THAT(begin_addition({{"f", "x"}}).error, HasSubstr("being added already"));
  EXPECT_EQ(call("add.cancel", Json{{"addition", open.front()}}).error, "");
  EXPECT_EQ(begin_addition({{"f", "x"}}).error, "");
}

TEST_F(AddPageTest, BytesThatAreNotTheNextAreRefused) {
  const std::int64_t addition = number(begin_addition({{"a", "123456"}, {"b", "x"}}));
  EXPECT_THAT(send(addition, 1, 0, "x").error, HasSubstr("not the next"));
  EXPECT_THAT(send(addition, 0, 1, "x").error, HasSubstr("not the next"));
  EXPECT_THAT(send(addition, 0, 0, "1234567").error, HasSubstr("longer"));
  EXPECT_THAT(call("add.bytes", Json{{"addition", addition}, {"file", 0}, {"at", 0}, {"base64", "?"}}).error,
              HasSubstr("base64"));
  EXPECT_EQ(send(addition, 0, 0, "123").error, "") << "a refusal changes nothing";
  EXPECT_THAT(send(addition, 0, 0, "123").error, HasSubstr("not the next"));
  EXPECT_THAT(finish(addition).error, HasSubstr("has not arrived completely"));
  EXPECT_TRUE(wait([&] { return names_in(folder.path()).empty(); }));
}

TEST_F(AddPageTest, AWindowThatGoesLeavesNothingAndAnotherCannotMeddle) {
  const std::int64_t addition = number(begin_addition({{"a", "123"}}));
  EXPECT_THAT(send(addition, 0, 0, "123", kClient + 1).error, HasSubstr("has ended"));
  EXPECT_THAT(call("add.end", Json{{"addition", addition}}, kClient + 1).error, HasSubstr("has ended"));
  EXPECT_EQ(send(addition, 0, 0, "12").error, "");
  page->client_left(kClient);
  EXPECT_TRUE(wait([&] { return names_in(folder.path()).empty(); }));
  EXPECT_THAT(send(addition, 0, 2, "3").error, HasSubstr("has ended"));
}

TEST_F(AddPageTest, TheBeginningRemovesWhatAKilledStudioLeft) {
  const fs::path stale = folder / ".asperity-studio-aB3dE9";
  fs::create_directory(stale);
  std::ofstream(stale / ".asperity-temporary") << "";
  remove_stale_temporary_folders(folder.path());
  EXPECT_FALSE(fs::exists(stale));
}

// A body that rotates about all axes and moves, seen by a tracker at 100 Hz and measured by a sensor at 500 Hz.
struct Motion {
  std::string poses = "time [ms];px [mm];py [mm];pz [mm];qw;qx;qy;qz\n";
  std::string sensor = "time [ms];ax [g];ay [g];az [g];gx [deg/s];gy [deg/s];gz [deg/s]\n";

  Motion() {
    constexpr double kGravity = 9.80665, kDegrees = 57.29577951308232;
    const auto line = [](std::ostringstream& out, std::initializer_list<double> values) {
      bool first = true;
      for (const double value : values) {
        out << (first ? "" : ";") << value;
        first = false;
      }
      out << "\n";
    };
    std::ostringstream pose_text, sensor_text;
    pose_text.precision(12);
    sensor_text.precision(12);
    // Rotation about z, tilted by nothing else: angle A(t); position along x.
    for (int i = 0; i < 5000; ++i) {
      const double t = 0.002 * i, angle = 0.8 * std::sin(2.1 * t) + 0.5 * std::sin(3.7 * t + 1.0),
                   rate = 0.8 * 2.1 * std::cos(2.1 * t) + 0.5 * 3.7 * std::cos(3.7 * t + 1.0),
                   x = 0.1 * std::sin(5.0 * t), a = -0.1 * 25.0 * std::sin(5.0 * t);
      if (i % 5 == 0)
        line(pose_text, {1000.0 * t, 1000.0 * x, 0.0, 50.0, std::cos(angle / 2), 0.0, 0.0, std::sin(angle / 2)});
      line(sensor_text, {1000.0 * t, a * std::cos(angle) / kGravity, -a * std::sin(angle) / kGravity, 1.0, 0.0, 0.0,
                         rate * kDegrees});
    }
    poses += pose_text.str();
    sensor += sensor_text.str();
  }
};

class ImportPageTest : public AddPageTest {
 protected:
  ImportPageTest() {
    std::ofstream(folder / "poses.csv") << motion_.poses;
    std::ofstream(folder / "sensor.csv") << motion_.sensor;
  }
  static Json arguments(const Json& settings = Json::object()) {
    return Json{{"files", {{"pose", "poses.csv"}, {"imu", "sensor.csv"}}}, {"settings", settings}};
  }

  Motion motion_;
};

TEST_F(ImportPageTest, ShowsColumnsCellsMeaningsAndWhatTheChecksFind) {
  const FakeHub::Answer answer = call("import.look", arguments());
  ASSERT_EQ(answer.error, "");
  const Json& plan = answer.result;
  EXPECT_EQ(plan["fault"], "");
  EXPECT_EQ(plan["doubts"].size(), 0U);
  EXPECT_THAT(plan["checks"].get<std::string>(), HasSubstr("z points up"));
  ASSERT_EQ(plan["files"].size(), 2U);
  const Json& poses = plan["files"][0];
  EXPECT_EQ(poses["file"], "poses.csv");
  EXPECT_EQ(poses["rows"], 1000);
  EXPECT_EQ(poses["columns"][1].dump(), R"({"number":2,"label":"px","unit":"mm"})");
  EXPECT_EQ(poses["cells"].size(), 6U);
  EXPECT_EQ(poses["cells"][0][3], "50");
  const auto meanings = [](const Json& file) {
    std::vector<std::string> out;
    for (const Json& one : file["map"])
      out.push_back(one["meaning"].get<std::string>() + one["unit"].get<std::string>());
    return out;
  };
  EXPECT_THAT(meanings(poses), ElementsAre("tms", "pxmm", "pymm", "pzmm", "qw1", "qx1", "qy1", "qz1"));
  EXPECT_EQ(names_in(folder.path()).size(), 2U) << "looking writes nothing";
}

TEST_F(ImportPageTest, ShowsTheFileWhereItCannotBeUnderstoodAndWhy) {
  std::ofstream(folder / "poses.csv") << "alpha,beta\n1,2\n3,4\n5,6\n";
  const FakeHub::Answer answer = call("import.look", arguments());
  ASSERT_EQ(answer.error, "");
  EXPECT_NE(answer.result["fault"], "");
  ASSERT_GE(answer.result["files"].size(), 1U);
  EXPECT_EQ(answer.result["files"][0]["columns"].size(), 2U);
  EXPECT_EQ(answer.result["files"][0]["cells"][1][0], "3");
}

TEST_F(ImportPageTest, WritesTheRecordingAndRefusesAWrongUnitWithItsName) {
  Json arguments_ = arguments();
  arguments_["name"] = "wave";
  const FakeHub::Answer answer = call("import.write", arguments_);
  ASSERT_EQ(answer.error, "");
  const Recording recording = read_recording(folder / "wave");
  EXPECT_EQ(recording.tracker.size(), 1000U);
  EXPECT_EQ(recording.probe.size(), 5000U);
  EXPECT_THAT(call("import.write", arguments_).error, HasSubstr("exists already"));

  Json wrong = arguments(Json{{"mapping.imu.columns", "a=#2-#4[m/s2], g=#5-#7[deg/s], t=#1[ms]"}});
  const FakeHub::Answer look = call("import.look", wrong);
  ASSERT_EQ(look.error, "");
  ASSERT_GE(look.result["doubts"].size(), 1U);
  EXPECT_THAT(look.result["doubts"][0].get<std::string>(), HasSubstr("m/s2"));
  // One axis alone, which the size of gravity hardly shows.
  const Json one_axis =
      arguments(Json{{"mapping.imu.columns", "ax=#2[m/s2], ay=#3[g], az=#4[g], g=#5-#7[deg/s], t=#1[ms]"}});
  EXPECT_THAT(call("import.look", one_axis).result["doubts"][0].get<std::string>(), HasSubstr("different units"));
  wrong["name"] = "wrong";
  EXPECT_NE(call("import.write", wrong).error, "");
  EXPECT_FALSE(fs::exists(folder / "wrong"));
}

TEST_F(ImportPageTest, RefusesFilesElsewhereAndSettingsThatAreNone) {
  for (const char* args :
       {R"({"files":{"pose":"../a"},"settings":{}})", R"({"files":{"pose":"none.csv"},"settings":{}})",
        R"({"files":{"pose":7},"settings":{}})", R"({"files":{},"settings":{}})", R"({"settings":{}})",
        R"({"files":{"pose":"poses.csv"}})", R"({"files":{"pose":"poses.csv"},"settings":{"mapping.upp":"z"}})",
        R"({"files":{"pose":"poses.csv"},"settings":{"mapping.clocks":"three"}})",
        R"({"files":{"pose":"poses.csv"},"settings":{"mapping.up":3}})"}) {
    EXPECT_NE(call("import.look", parse_json(args)).error, "") << args;
  }
}

// A sine of 3 µm: Rq = 3/√2 µm, and the texture that is made of it has that, too.
TEST_F(AddPageTest, AProfileIsLookedAtAndMadeATexture) {
  std::ofstream file(project.folder() / "sine.csv");
  file << "x_mm,z_um\n";
  for (int i = 0; i < 4000; ++i) file << 0.005 * i << ',' << 3.0 * std::sin(2.0 * std::numbers::pi * i / 100.0) << '\n';
  file.close();
  const auto look = call("surface.look", Json{{"file", "sine.csv"}, {"spacing_mm", 0.0}});
  ASSERT_EQ(look.error, "");
  EXPECT_EQ(look.result["kind"].get<std::string>(), "profile");
  EXPECT_EQ(look.result["points"].get<int>(), 4000);
  std::string rq;
  for (const Json& parameter : look.result["parameters"]) {
    if (parameter["key"].get<std::string>() == "Rq") rq = parameter["value"].get<std::string>();
  }
  EXPECT_NEAR(std::stod(rq), 3.0 / std::numbers::sqrt2, 0.01);
  const auto picture = bytes_of_base64(look.result["picture"].get<std::string>());
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->starts_with("\x89PNG")) << look.result["note"].get<std::string>();

  const Json wanted{{"file", "sine.csv"}, {"spacing_mm", 0.0}, {"name", "sine.texture.json"}};
  ASSERT_EQ(call("surface.texture", wanted).error, "");
  const Texture texture = read_texture(project.folder() / "sine.texture.json");
  EXPECT_EQ(texture.name, "sine");
  ASSERT_TRUE(texture.roughness.contains("Rq_m"));
  EXPECT_NEAR(texture.roughness.at("Rq_m"), 3e-6 / std::numbers::sqrt2, 1e-8);
  EXPECT_NE(call("surface.texture", wanted).error, "") << "it is replaced only if that is wanted";
}

TEST_F(AddPageTest, AMapIsLookedAtAndMissingHeightsAreCounted) {
  std::ofstream file(project.folder() / "map.csv");
  file << "x_mm,y_mm,z_um\n";
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 50; ++column) {
      file << 0.1 * column << ',' << 0.1 * row << ',';
      if (row == 7 && column == 9) {
        file << "nan\n";
        continue;
      }
      file << std::sin(0.7 * column) + std::cos(0.5 * row);
      file << '\n';
    }
  }
  file.close();
  const auto look = call("surface.look", Json{{"file", "map.csv"}, {"spacing_mm", 0.0}});
  ASSERT_EQ(look.error, "");
  EXPECT_EQ(look.result["kind"].get<std::string>(), "map");
  EXPECT_EQ(look.result["points"].get<int>(), 2000);
  EXPECT_EQ(look.result["missing"].get<int>(), 1);
  EXPECT_GE(look.result["parameters"].size(), 20u);
  const auto made =
      call("surface.texture", Json{{"file", "map.csv"}, {"spacing_mm", 0.0}, {"name", "map.texture.json"}});
  EXPECT_EQ(made.error, "");
  EXPECT_EQ(read_texture(project.folder() / "map.texture.json").model_name(), "areal");
}

TEST_F(AddPageTest, WhatIsNoSurfaceIsNamed) {
  std::ofstream(project.folder() / "letter.txt") << "dear friend,\nhow are you?\n";
  EXPECT_THAT(call("surface.look", Json{{"file", "letter.txt"}, {"spacing_mm", 0.0}}).error, HasSubstr("letter.txt"));
  std::ofstream(project.folder() / "one.csv") << "height_um\n1\n2\n3\n";
  EXPECT_THAT(call("surface.look", Json{{"file", "one.csv"}, {"spacing_mm", 0.0}}).error, HasSubstr("spacing"));
  EXPECT_NE(call("surface.look", Json{{"file", "one.csv"}, {"spacing_mm", -1.0}}).error, "");
  EXPECT_NE(call("surface.look", Json{{"file", "../one.csv"}, {"spacing_mm", 0.0}}).error, "");
  EXPECT_NE(call("surface.texture", Json{{"file", "letter.txt"}, {"spacing_mm", 0.0}, {"name", "letter"}}).error, "");
}

}  // namespace
}  // namespace asperity::studio
