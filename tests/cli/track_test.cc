#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "../tracking/tag_scene.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string pgm(const GrayImage& image) {
  return "P5\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n" +
         std::string(image.pixels.begin(), image.pixels.end());
}

std::string camera_json(const CameraCalibration& camera) {
  const nlohmann::json json = {{"format", "asperity-calibration"},
                               {"version", 1},
                               {"camera",
                                {{"width", camera.width},
                                 {"height", camera.height},
                                 {"fx", camera.fx},
                                 {"fy", camera.fy},
                                 {"cx", camera.cx},
                                 {"cy", camera.cy},
                                 {"distortion", camera.distortion}}}};
  return json.dump();
}

std::string markers_json(const std::vector<MarkerPlacement>& body) {
  nlohmann::json markers = nlohmann::json::array();
  for (const MarkerPlacement& tag : body) {
    const Eigen::Vector3d& t = tag.T_marker_tag.translation_m;
    const Eigen::Quaterniond& q = tag.T_marker_tag.rotation;
    markers.push_back({{"id", tag.id},
                       {"family", tag.family},
                       {"size_m", tag.size_m},
                       {"T_marker_tag", {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}}});
  }
  return nlohmann::json{{"markers", markers}}.dump();
}

// A folder with a camera, a body and three images of it.
class Track : public testing::Test {
 protected:
  Track() {
    TagScene scene;
    scene.camera = test_camera();
    scene.body = sleeve();
    scene.rays = 3;
    write_text(dir_ / "calibration.json", camera_json(scene.camera));
    write_text(dir_ / "markers.json", markers_json(scene.body));
    std::filesystem::create_directory(dir_ / "images");
    for (int i = 0; i < 3; ++i) {
      truth_.push_back(random_view(0.35, 0.4, static_cast<std::uint64_t>(40 + i)));
      write_text(dir_ / "images" / (std::to_string(1'000'000'000LL * (i + 1)) + ".pgm"),
                 pgm(draw(scene, truth_.back(), static_cast<std::uint64_t>(i))));
    }
  }

  Outcome track(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"track",     path("images"),       "--camera", path("calibration.json"),
                                 "--markers", path("markers.json"), "-o",       path("tracker.csv")};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  testkit::TempDir dir_;
  std::vector<Pose> truth_;
};

TEST_F(Track, WritesThePosesThatWereDrawn) {
  const Outcome outcome = track({"--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["format"], "asperity-tracked");
  EXPECT_EQ(report["frames"], 3);
  EXPECT_EQ(report["poses"], 3);
  EXPECT_EQ(report["tag_frame_declared"], "apriltag");
  std::istringstream table(read_text(path("tracker.csv")));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line.rfind("t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,markers,reprojection_px,", 0), 0u);
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    ASSERT_TRUE(std::getline(table, line));
    std::vector<double> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(std::stod(cell));
    ASSERT_EQ(cells.size(), 22u);  // σ of all, and of the frame alone
    EXPECT_EQ(cells[0], 1e9 * static_cast<double>(i + 1));
    // Clean images at 0.35 m: docs/tracking.md has 0.03 mm at 95 %.
    const Eigen::Vector3d found_m(cells[1], cells[2], cells[3]);
    EXPECT_LT((found_m - truth_[i].translation_m).norm(), 1e-4);
    const Eigen::Quaterniond turned(cells[4], cells[5], cells[6], cells[7]);
    EXPECT_LT(turned.angularDistance(truth_[i].rotation), 2e-3);
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST_F(Track, AgainOverItsOwnTableGivesTheSameBytes) {
  ASSERT_EQ(track().code, 0);
  const std::string first = read_text(path("tracker.csv"));
  ASSERT_EQ(track().code, 0);
  EXPECT_EQ(read_text(path("tracker.csv")), first);
}

TEST_F(Track, AStrangersFileStays) {
  write_text(dir_ / "tracker.csv", "mine\n");
  const Outcome outcome = track();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("tracker.csv"));
  EXPECT_EQ(read_text(path("tracker.csv")), "mine\n");
}

TEST_F(Track, WithoutACameraItSaysWhichFile) {
  std::filesystem::remove(dir_ / "calibration.json");
  const Outcome outcome = track();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("calibration.json"));
  EXPECT_FALSE(std::filesystem::exists(dir_ / "tracker.csv"));
}

TEST_F(Track, AnotherCamerasImageIsRefusedWithBothSizes) {
  GrayImage small;
  small.width = 320;
  small.height = 240;
  small.pixels.assign(320 * 240, 100);
  write_text(dir_ / "images" / "4000000000.pgm", pgm(small));
  const Outcome outcome = track();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("320×240"));
  EXPECT_THAT(outcome.err, HasSubstr("640×480"));
}

TEST_F(Track, ADamagedImageIsNamed) {
  write_text(dir_ / "images" / "4000000000.png", std::string("\x89PNG\r\n\x1a\n", 8) + "no more");
  const Outcome outcome = track();
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("4000000000.png"));
}

TEST_F(Track, WithoutTagsInTheImagesItIsNotToBeTrusted) {
  GrayImage empty;
  empty.width = 640;
  empty.height = 480;
  empty.pixels.assign(640 * 480, 128);
  for (int i = 1; i <= 3; ++i) write_text(dir_ / "images" / (std::to_string(1'000'000'000LL * i) + ".pgm"), pgm(empty));
  const Outcome outcome = track();
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("0 of 3 images"));
}

TEST_F(Track, ImagesWithoutTimesNeedARate) {
  std::filesystem::rename(dir_ / "images" / "1000000000.pgm", dir_ / "images" / "a.pgm");
  EXPECT_THAT(track().err, HasSubstr("--rate"));
  EXPECT_EQ(track({"--rate", "30"}).code, 0);
}

}  // namespace
}  // namespace asperity::cli
