#include <filesystem>
#include <memory>
#include <string>

#include "asperity/base/text.h"
#include "asperity/studio/studio.h"
#include "asperity/web/assets.h"
#include "commands.h"
#include "interrupt.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

class StudioCommand : public Command {
 public:
  explicit StudioCommand(CLI::App& root)
      : Command(root, "studio", "Scan, process, align, paint and feel in a browser") {
    parser().add_option("WHAT", what_, "A recording, a scene or a mesh; its folder is worked in, else the current one");
    parser()
        .add_option("--port", config_.server.port, "0 (the default): a free one")
        ->check(CLI::Range(0, 65535))
        ->type_name("N");
    parser().add_option("--host", config_.server.host, "Address to listen at; 127.0.0.1")->type_name("ADDRESS");
    parser().add_flag("--remote-force", config_.remote_force,
                      "With --host: browsers of other machines may command forces too");
    parser().add_flag("--no-open", no_open_, "Do not open a browser");
  }

  int run(const Observer&) override {
    if (!web::built()) {
      throw Error(
          "this asperity was built without the studio, because Node.js was not found; install it (scripts/bootstrap) "
          "and "
          "build again");
    }
    config_.folder = fs::current_path();
    if (!what_.empty()) {
      const fs::path what = fs::absolute(what_).lexically_normal();
      const fs::path whole = what.has_filename() ? what : what.parent_path();
      if (!fs::exists(whole)) throw Error(printable(what_, 200) + ": no such file or folder");
      config_.folder = whole.parent_path();
      config_.open = whole.filename().string();
    }
    studio::run_studio(
        config_, [this](const std::string& address) { say("studio     " + address + "\n"); }, interrupt_flag());
    return kDone;
  }

 private:
  std::string what_;
  bool no_open_ = false;
  studio::StudioConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_studio(CLI::App& root) { return std::make_unique<StudioCommand>(root); }

}  // namespace asperity::app
