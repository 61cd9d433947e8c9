#include "asperity/studio/project.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "asperity/studio/calls.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

TEST(Project, ListsWhatCanBeOpened) {
  const testkit::TempDir folder;
  for (const char* name : {"rec/recording.json", "rec/frames/1.png", "out/result.json", "out/profile.csv",
                           "out/texture.json", "toy/scene.json", "toy/toy.obj", ".hidden/x.obj", "a/b/c/d/deep.obj"}) {
    touch(folder / name);
  }
  fs::create_symlink("/", folder / "root");
  std::vector<std::string> names;
  for (const Entry& entry : Project(folder.path()).entries()) names.push_back(entry.name);
  EXPECT_THAT(names, ::testing::ElementsAre("out", "out/texture.json", "rec", "toy/scene.json", "toy/toy.obj"));
}

TEST(Project, NamesNothingOutside) {
  const testkit::TempDir folder;
  touch(folder / "in/file.obj");
  fs::create_directory_symlink("/etc", folder / "in/link");
  const Project project(folder.path());
  EXPECT_EQ(project.existing("in/file.obj"), fs::canonical(folder / "in/file.obj"));
  for (const char* name : {"/etc/passwd", "../x", "in/../../x", "in/link/passwd", "", ".", "in/none.obj",
                           "in\\..\\..\\x", "C:/x", ".git/config", "in/.x", "\xff"}) {
    try {
      project.existing(name);
      ADD_FAILURE() << name << " is taken";
    } catch (const Advice& refused) {
      EXPECT_NE(refused.hint(), "") << name;
    }
  }
  EXPECT_EQ(project.writable("in/new.obj"), fs::canonical(folder.path()) / "in/new.obj");
  EXPECT_THROW(project.writable("none/new.obj"), Advice);
  EXPECT_THROW(project.writable("in/link/new"), Error);
}

TEST(Project, FindsAFreeName) {
  const testkit::TempDir folder;
  const Project project(folder.path());
  EXPECT_EQ(project.free_name("scan"), "scan");
  touch(folder / "scan");
  fs::create_symlink("nowhere", folder / "scan_2");
  EXPECT_EQ(project.free_name("scan"), "scan_3");
}

}  // namespace
}  // namespace asperity::studio
