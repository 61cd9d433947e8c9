// What belongs to the project as a whole: the unit of meshes without one, the axis that is up, what a mesh is.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "align/align_choice.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"
#include "page_rig.h"
#include "paint/paint_page.h"
#include "setup/project_setup.h"
#include "setup/setup_page.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A tetrahedron at the corner of a cube of the given side, in the file's unit.
void write_corner(const fs::path& file, const std::string& side) {
  std::ofstream out(file);
  out << "v 0 0 0\nv " << side << " 0 0\nv 0 " << side << " 0\nv 0 0 " << side << '\n';
  out << "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

class SetupPageTest : public ::testing::Test, protected PageRig<> {
 protected:
  SetupPageTest() { open(make_setup_page(shared)); }

  Json info(const char* file, const char* unit = "") {
    const FakeHub::Answer answer = call("mesh.info", Json{{"file", file}, {"unit", unit}});
    EXPECT_EQ(answer.error, "");
    return answer.result;
  }
};

TEST_F(SetupPageTest, MeshWithoutAUnitIsReadInThatOfTheProject) {
  write_corner(folder / "corner.obj", "30");
  Json found = info("corner.obj");
  EXPECT_EQ(found["unit_from"], "project");
  EXPECT_EQ(found["unit_m"], 1.0);
  EXPECT_EQ(found["likely"], false);  // 42 m
  document.edit("/project/mesh_unit", "mm", "the unit");
  found = info("corner.obj");
  EXPECT_EQ(found["unit_m"], 0.001);
  EXPECT_EQ(found["likely"], true);
  EXPECT_NEAR(found["size_m"][0].get<double>(), 0.03, 1e-15);
  EXPECT_NEAR(found["volume_m3"].get<double>(), 2.7e-5 / 6.0, 1e-18);
  EXPECT_NEAR(found["area_m2"].get<double>(), 9e-4 * (1.5 + 0.5 * std::numbers::sqrt3), 1e-15);
  EXPECT_NEAR(found["edge_m"][2].get<double>(), 0.03 * std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(found["parts"], 1);
  EXPECT_EQ(found["closed"], true);
  EXPECT_EQ(found["normals"], false);
  document.undo();
  EXPECT_EQ(info("corner.obj")["unit_m"], 1.0);
}

TEST_F(SetupPageTest, UnitOfThePageIsUsedFirst) {
  write_corner(folder / "corner.obj", "3");
  document.edit("/project/mesh_unit", "mm", "the unit");
  const Json found = info("corner.obj", "cm");
  EXPECT_EQ(found["unit_from"], "page");
  EXPECT_EQ(found["unit_m"], 0.01);
}

TEST_F(SetupPageTest, SceneOfAFolderMayNotLeadOutOfTheProject) {
  const testkit::TempDir elsewhere;
  write_corner(elsewhere / "corner.obj", "3");
  const char* scene = R"({"format": "asperity-scene", "version": 1, "mesh": "corner.obj", "textures": []})";
  std::ofstream(elsewhere / "scene.json") << scene;
  fs::create_directory(folder / "linked");
  fs::create_symlink(elsewhere / "scene.json", folder / "linked" / "scene.json");
  write_corner(folder / "linked" / "corner.obj", "3");
  EXPECT_THAT(call("mesh.info", Json{{"file", "linked"}, {"unit", ""}}).error,
              HasSubstr("linked/scene.json: is a link that leads out of the project's folder"));
  fs::create_directory(folder / "own");
  std::ofstream(folder / "own" / "scene.json") << scene;
  write_corner(folder / "own" / "corner.obj", "3");
  EXPECT_EQ(info("own")["triangles"], 4);
}

TEST_F(SetupPageTest, UnitThatTheFileStatesIsNotTheProjects) {
  write_corner(folder / "corner.obj", "3");
  std::ofstream(folder / "scene.json")
      << R"({"format": "asperity-scene", "version": 1, "mesh": "corner.obj", "unit_m": 0.02, "textures": []})";
  document.edit("/project/mesh_unit", "mm", "the unit");
  const Json found = info("scene.json");
  EXPECT_EQ(found["unit_from"], "file");
  EXPECT_EQ(found["unit_m"], 0.02);
  EXPECT_NEAR(found["size_m"][2].get<double>(), 0.06, 1e-15);
  // glTF is in metres by its standard.
  EXPECT_EQ(mesh_reading("a.glb", "", {"mm", "z"}).unit_m, 1.0);
  EXPECT_EQ(mesh_reading("a.glb", "cm", {"mm", "z"}).unit_m, 0.01);
}

TEST_F(SetupPageTest, AttributesAndFaultsOfTheFileAreShown) {
  std::ofstream(folder / "sheet.obj") << "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nv 9 9 9\nvt 0 0\nvn 0 0 1\n"
                                         "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\nf 1 2 2\n";
  const Json found = info("sheet.obj");
  EXPECT_EQ(found["texture_coordinates"], true);
  EXPECT_EQ(found["normals"], true);
  EXPECT_EQ(found["closed"], false);
  EXPECT_EQ(found["open_edges"], 4);
  EXPECT_TRUE(found["volume_m3"].is_null());
  EXPECT_EQ(found["vertices"], 5);
  EXPECT_EQ(found["positions"], 4);  // the fifth is used by no triangle
}

TEST_F(SetupPageTest, SectionRefusesWhatIsNoSetup) {
  EXPECT_THROW(document.edit("/project/mesh_unit", "furlong", ""), Error);
  EXPECT_THROW(document.edit("/project/mesh_unit", 1, ""), Error);
  EXPECT_THROW(document.edit("/project/up", "x", ""), Error);
  EXPECT_THROW(document.edit("/project/no", "x", ""), Error);
  EXPECT_NO_THROW(document.edit("/project/up", "y", ""));
}

TEST(ProjectSetup, OfAnOlderDocumentIsTheDefault) {
  PageRig<> rig;
  std::ofstream(rig.folder / ".asperity-studio.json")
      << R"({"format": "asperity-studio", "version": 1, "document": {}, "undo": [], "redo": []})";
  rig.open(make_setup_page(rig.shared));
  EXPECT_EQ(project_setup(rig.document).mesh_unit, "m");
  EXPECT_EQ(project_setup(rig.document).up, "z");
  EXPECT_TRUE(rig.document.problems().empty());
}

// Both pages, of which the rig opens one.
class PaintInProject : public ::testing::Test, protected PageRig<> {
 protected:
  PaintInProject() {
    setup_->bind(document, calls);
    write_corner(folder / "corner.obj", "30");
    open(make_paint_page(shared));
    document.edit("/paint/object", "corner.obj", "open");
  }

  std::unique_ptr<Page> setup_ = make_setup_page(shared);
};

TEST_F(PaintInProject, AsksForTheUnitUntilItIsLikely) {
  const FakeHub::Answer refused = call("paint.show");
  EXPECT_THAT(refused.error, HasSubstr("corner.obj states no unit and is 52 m large in the project's unit (m)"));
  document.edit("/project/mesh_unit", "mm", "the unit");
  EXPECT_EQ(call("paint.show").error, "");
  document.edit("/project/mesh_unit", "um", "the unit");  // 52 um
  EXPECT_THAT(call("paint.show").error, HasSubstr("0.052 mm large in the project's unit (um)"));
  document.edit("/paint/unit_m", 1.0, "the page's own unit is believed");
  EXPECT_EQ(call("paint.show").error, "");
  document.edit("/paint/unit_m", nullptr, "the project's again");
  EXPECT_NE(call("paint.show").error, "");
}

TEST(AlignInProject, UnitIsThePagesOrTheProjects) {
  AlignChoice choice;
  choice.mesh = "a.obj";
  choice.project.mesh_unit = "cm";
  EXPECT_EQ(unit_to_read_m(choice), 0.01);
  choice.mesh_unit = "mm";
  EXPECT_EQ(unit_to_read_m(choice), 0.001);
  choice.mesh = "scene.json";
  EXPECT_EQ(unit_to_read_m(choice), std::nullopt);
  choice.mesh = "a.glb";
  choice.mesh_unit = "";
  EXPECT_EQ(unit_to_read_m(choice), 1.0);
}

}  // namespace
}  // namespace asperity::studio
