#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "asperity/base/version.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/scene/write_scene.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class TextureSwapCommand : public Command {
 public:
  explicit TextureSwapCommand(CLI::App& root)
      : Command(root, "swap", "Lay another texture in the place of one of a scene's") {
    require(parser().add_option("SCENE", scene_, "A *.scene.json"));
    require(parser().add_option("INDEX", index_, "The texture's number in the mesh's h lines"));
    require(parser().add_option("TEXTURE", texture_, "The *.texture.json to lay there"));
    parser()
        .add_option("-o,--output", output_, "The new scene; SCENE itself unless given")
        ->type_name("OUT.scene.json");
  }

  int run(const Observer&) override {
    Scene scene = read_scene(scene_);
    const std::string file = fs::path(texture_).filename().string();
    const SceneTexture* before = scene.objects.empty() ? nullptr : scene.objects.front().find_texture(index_);
    const std::string old = before ? before->file : std::string();
    swap_texture(scene, index_, read_texture(texture_), file);
    const std::string target = output_.empty() ? scene_ : output_;
    write_scene(target, scene);
    Json out;
    out["format"] = "asperity-texture-swap";
    out["version"] = 1;
    out["scene"] = target;
    out["index"] = index_;
    out["before"] = old.empty() ? Json(nullptr) : Json(old);
    out["after"] = file;
    out["asperity"] = kVersion;
    print_json(out.dump(2, ' ', false, Json::error_handler_t::replace));
    say(fmt::format("{}: texture {} is now {}{}\n", target, index_, file, old.empty() ? "" : ", before " + old));
    return kDone;
  }

 private:
  std::string scene_;
  int index_ = 0;
  std::string texture_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_texture_swap(CLI::App& root) { return std::make_unique<TextureSwapCommand>(root); }

}  // namespace asperity::app
