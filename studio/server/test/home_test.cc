// The first run: recent projects, the sample project, documents, and what is left of a scan that was not finished.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "asperity/base/csv.h"
#include "asperity/profile/read_heights.h"
#include "asperity/recording/read_recording.h"
#include "asperity/texture/texture_file.h"
#include "document_answer.h"
#include "home/home_page.h"
#include "home/recent_projects.h"
#include "home/sample_project.h"
#include "page_rig.h"
#include "scan/open_scan.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(RecentProjects, AreNewestFirstAndRememberTheirPort) {
  const testkit::TempDir folder;
  const fs::path file = folder / "state" / "studio.json";
  EXPECT_TRUE(read_recent_projects(file).empty());
  add_recent_project(file, {"/a", "2026-01-01T00:00:00Z", 8001});
  add_recent_project(file, {"/b", "2026-01-02T00:00:00Z", 8002});
  add_recent_project(file, {"/a", "2026-01-03T00:00:00Z", 8003});
  const auto recent = read_recent_projects(file);
  ASSERT_EQ(recent.size(), 2U);
  EXPECT_EQ(recent[0].folder, "/a");
  EXPECT_EQ(remembered_port(file, "/a"), 8003);
  EXPECT_EQ(remembered_port(file, "/b"), 8002);
  EXPECT_EQ(remembered_port(file, "/c"), 0);
  for (int k = 0; k < 20; ++k) add_recent_project(file, {"/n" + std::to_string(k), "", 1});
  EXPECT_EQ(read_recent_projects(file).size(), kMostRecentProjects);
}

TEST(RecentProjects, OfADamagedFileAreNone) {
  const testkit::TempDir folder;
  for (const char* text : {"", "{", "[]", R"({"projects":{}})", R"({"projects":[{"folder":1,"opened":"","port":1}]})",
                           R"({"projects":[{"folder":"/a","opened":"","port":99999}]})"}) {
    write(folder / "studio.json", text);
    EXPECT_TRUE(read_recent_projects(folder / "studio.json").empty()) << text;
  }
}

TEST(HomePage, ListsOtherProjectsWhoseFolderExists) {
  PageRig<> rig;
  const testkit::TempDir other;
  const fs::path file = other / "studio.json";
  add_recent_project(file, {"/gone/for/good", "", 1});
  add_recent_project(file, {other.path().string(), "2026-01-02T00:00:00Z", 1});
  add_recent_project(file, {rig.folder.path().string(), "", 1});
  rig.open(make_home_page(rig.shared, file));
  const Json recent = rig.call("home.recent").result;
  ASSERT_EQ(recent.size(), 1U);
  EXPECT_EQ(recent[0]["folder"], other.path().string());
}

TEST(SampleProject, HasScansTexturesAndARealProfile) {
  PageRig<> rig;
  rig.open(make_home_page(rig.shared, {}));
  const auto answer = rig.call("home.sample");
  ASSERT_EQ(answer.error, "");
  EXPECT_EQ(answer.result["recording"], "sample/protoboard");
  const fs::path sample = rig.folder / "sample";
  EXPECT_GT(read_recording(sample / "protoboard").probe.size(), 1000U);
  for (const char* name : {"protoboard", "sandpaper", "cable_tie"}) {
    EXPECT_NO_THROW(read_texture(sample / "results" / name / "texture.json")) << name;
  }
  // As the spacing in its README.txt.
  const auto heights = read_heights(sample / "stylus" / "profile.csv", {.spacing_m = 0.5e-6});
  EXPECT_GT(std::get<HeightProfile>(heights).height_m.size(), 5000U);
  EXPECT_THAT(read_file(sample / "stylus" / "LICENSE", 1 << 20), HasSubstr("MIT License"));
  EXPECT_EQ(rig.call("home.sample").result["folder"], "sample_2");
}

TEST(DocumentAnswer, ServesFilesOfTheSiteAndNothingElse) {
  const testkit::TempDir folder;
  const fs::path site = folder / "site";
  fs::create_directories(site / "start");
  write(site / "index.html", "all");
  write(site / "start" / "install.html", "install");
  write(site / ".hidden.html", "no");
  write(folder / "secret.html", "no");
  const auto get = [&](std::string_view path) { return answer_document(path, site); };
  EXPECT_EQ(get("/docs").body, "all");
  EXPECT_EQ(get("/docs/").body, "all");
  EXPECT_EQ(get("/docs/start/install.html").body, "install");
  for (const char* path : {"/docs/../secret.html", "/docs/%2e%2e/secret.html", "/docs/.hidden.html",
                           "/docs//index.html", "/docsindex.html", "/docs/start", "/docs/none.html"}) {
    EXPECT_EQ(get(path).status, 404U) << path;
  }
  bool has_policy = false;
  for (const auto& [name, value] : get("/docs/").headers) {
    if (name == "Content-Security-Policy") has_policy = value.find("connect-src 'none'") != std::string::npos;
  }
  EXPECT_TRUE(has_policy) << "a page of the documents cannot speak to the studio";
}

TEST(DocumentAnswer, WithoutTheSiteStatesHowToGetIt) {
  const testkit::TempDir folder;
  for (const fs::path& site : {fs::path(), folder / "none"}) {
    const HttpAnswer answer = answer_document("/docs/studio.html", site);
    EXPECT_EQ(answer.status, 404U);
    EXPECT_THAT(answer.body, HasSubstr("scripts/site"));
  }
}

TEST(OpenScan, WithoutANoteNothingIsRescued) {
  const testkit::TempDir folder;
  EXPECT_FALSE(find_rescued_scan(folder.path()));
  note_open_scan(folder.path(), "scan");
  EXPECT_FALSE(find_rescued_scan(folder.path())) << "no such recording";
  write(folder / ".asperity-scan.json", R"({"recording":"../../etc"})");
  EXPECT_FALSE(find_rescued_scan(folder.path()));
  forget_open_scan(folder.path());
  EXPECT_FALSE(fs::exists(folder / ".asperity-scan.json"));
}

TEST(OpenScan, OneThatCannotBeReadIsStated) {
  const testkit::TempDir folder;
  fs::create_directories(folder / "scan");
  write(folder / "scan" / "probe.csv", "t_ns\n");
  note_open_scan(folder.path(), "scan");
  const auto rescued = find_rescued_scan(folder.path());
  ASSERT_TRUE(rescued);
  EXPECT_EQ(rescued->recording, "scan");
  EXPECT_NE(rescued->problem, "");
}

}  // namespace
}  // namespace asperity::studio
