#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/our_file.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
class TextureSwapCommand : public Command {
 public:
  explicit TextureSwapCommand(Parser& root) : Command(root, "swap", "Replace a texture of a scene by another") {
    require(parser().add_option("SCENE", scene_, "A *.scene.json"));
    require(parser().add_option("INDEX", index_, "The texture's number in the mesh's h lines"));
    require(parser().add_option("TEXTURE", texture_, "The new texture, a *.texture.json"));
    parser()
        .add_option("-o,--output", output_, "File of the new scene, in any folder; default: SCENE itself")
        ->type_name("OUT.scene.json");
  }

  int run(const Observer& observer) override {
    const fs::path target = output_.empty() ? scene_ : output_;
    if (fs::path(scene_).extension() != ".json" || target.extension() != ".json")
      throw UsageError("the file of a scene ends in .scene.json");
    Scene scene = read_scene(scene_, observer);
    const SceneTexture* before = scene.objects.front().find_texture(index_);
    const std::string old = before ? before->file : std::string();
    swap_texture(scene, index_, read_texture(texture_, {}, observer), fs::path(texture_).filename().string());
    if (!output_.empty() && fs::exists(target) && !fs::equivalent(target, scene_))
      throw Error(printable(output_, 200) + ": exists; nothing was changed");
    refuse_stranger(target, [](std::string_view) { return true; });  // no link, which a file would replace
    const std::string file = folder_of(target) == folder_of(scene_) ? put_beside(scene) : put_elsewhere(scene, target);
    write_file(target, format_scene(scene));
    Json out;
    out["format"] = "asperity-texture-swap";
    out["version"] = 1;
    out["scene"] = target.string();
    out["index"] = index_;
    out["before"] = old.empty() ? Json(nullptr) : Json(old);
    out["after"] = file;
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(fmt::format("{}: texture {} is now {}{}\n", printable(target.string(), 200), index_, printable(file, 200),
                    old.empty() ? "" : ", before " + printable(old, 200)));
    return kDone;
  }

 private:
  static fs::path folder_of(const fs::path& file) { return fs::weakly_canonical(fs::absolute(file).parent_path()); }

  // Only the new texture is written: the scene's other files stay as they are. No file of another content is
  // replaced; the texture gets a number instead.
  std::string put_beside(Scene& scene) const {
    auto& textures = scene.objects.front().textures;
    const auto place = std::find_if(textures.begin(), textures.end(), [&](const auto& t) { return t.index == index_; });
    const fs::path folder = folder_of(scene_);
    std::vector<SceneFile> files = format_texture_in_scene(*place);
    for (int n = 2; find_other_content(folder, files); ++n) {
      place->file = fmt::format("{}-{}.texture.json", texture_stem(texture_), n);
      files = format_texture_in_scene(*place);
    }
    for (const SceneFile& one : files) write_file(folder / one.name, one.content);
    return place->file;
  }

  // All files of the scene go where no other is lost by it.
  std::string put_elsewhere(const Scene& scene, const fs::path& target) const {
    std::string after = scene.objects.front().find_texture(index_)->file;
    const std::vector<SceneFile> files = format_scene_files(target.filename().string(), scene);
    if (const auto taken = find_other_content(folder_of(target), files)) {
      throw Error(printable((target.parent_path() / *taken).string(), 200) +
                  ": exists with other content; nothing was changed");
    }
    for (const SceneFile& one : files) {
      fs::create_directories((folder_of(target) / one.name).parent_path());
      if (&one != &files.back()) write_file(folder_of(target) / one.name, one.content);
    }
    return after;
  }

  std::string scene_;
  int index_ = 0;
  std::string texture_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_texture_swap(Parser& root) { return std::make_unique<TextureSwapCommand>(root); }

}  // namespace asperity::app
