#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/session/interrupt.h"
#include "asperity/studio/feel_config.h"
#include "asperity/studio/open_browser.h"
#include "asperity/studio/studio.h"
#include "asperity/studio/web_server.h"
#include "asperity/web/assets.h"
#include "commands.h"
#include "studio_sessions.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// The documents as a site: of an installed program share/doc/asperity/html, of one that was built build/site.
fs::path documents_folder() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path installed = folder.parent_path() / "share" / "doc" / "asperity" / "html";
  if (error || fs::is_directory(installed, error)) return error ? fs::path() : installed;
  return folder.parent_path().parent_path() / "site";
}

class StudioCommand : public Command {
 public:
  explicit StudioCommand(Parser& root)
      : Command(root, "studio", "Scan, process, align, paint and render in a browser") {
    parser().add_option("WHAT", what_,
                        "A recording, scene or mesh, whose folder is opened, or a folder; default: the current folder");
    parser()
        .add_option("--port", config_.server.port, "0 (the default): a free one")
        ->in_range(0, 65535)
        ->type_name("N");
    parser()
        .add_option("--host", config_.server.host, "Address to listen at; default: 127.0.0.1")
        ->type_name("ADDRESS");
    parser().add_flag("--remote-force", config_.remote_force,
                      "With --host: browsers of other machines may command forces too");
    parser()
        .add_option("--tls-cert", certificate_, "Certificate (PEM) to speak https with; needs --tls-key")
        ->type_name("FILE");
    parser()
        .add_option("--tls-key", key_, "Key (PEM) of the certificate, for its owner's eyes alone")
        ->type_name("FILE");
    parser().add_flag("--no-open", no_open_, "Do not open a browser");
    Option* sessions = parser().add_flag("--sessions", list_, "List your running studios and their sessions, and stop");
    Option* token = parser().add_flag("--new-token", new_token_,
                                      "Renew the address of your running studio, end all its sessions, and stop");
    Option* close = parser()
                        .add_option("--close-session", close_, "End this session of your running studio, and stop")
                        ->in_range(1, 1'000'000'000)
                        ->type_name("N");
    sessions->excludes(token);
    sessions->excludes(close);
    token->excludes(close);
  }

  // With what the Feel page starts: devices, ports, drivers and limits are set here, never from a browser.
  std::vector<ConfigField> fields() override { return studio::feel_config_fields(feel_); }

  int run(const Observer&) override {
    if (list_ || new_token_ || parser().count("--close-session") > 0) return manage_running();
    if (!web::built()) {
      throw Error("this asperity was built without the studio. " + std::string(web::why_not_built()) +
                  ", and build again");
    }
    choose_folder();
    if (certificate_.empty() != key_.empty()) throw UsageError("--tls-cert and --tls-key need each other");
    config_.server.tls_certificate = certificate_;
    config_.server.tls_key = key_;
    config_.notice = [](const std::string& sentence) { print_error(sentence); };
    config_.server.documents = documents_folder();
    config_.recent = studio::recent_projects_file();
    config_.feel = std::make_shared<const studio::FeelConfig>(feel_);
    const bool is_open_to_others = !studio::is_this_machine_only(config_.server.host);
    std::optional<studio::OpenedBrowser> browser;
    // A signal waits until no hand has force on it (feel_run.cc) and everything is saved.
    const FinishHold finish;
    const auto started = [&](const std::string& address) {
      print_address(address, is_open_to_others);
      if (!no_open_) browser.emplace(address);
    };
    studio::run_studio(config_, started, interrupt_flag());
    return kDone;
  }

 private:
  int manage_running() {
    StudioChoice choice;
    choice.port = config_.server.port;
    if (!what_.empty()) {
      choose_folder();
      choice.folder = config_.folder;
    }
    if (list_) {
      const auto studios = chosen_studios(choice);
      print_json(sessions_json(studios));
      say(sessions_text(studios));
      return kDone;
    }
    const studio::RunningStudio chosen = chosen_studio(choice);
    if (new_token_) {
      const std::string address = studio::renew_token(chosen);
      print_address_json(address);
      say("studio     " + printable(address, 300) + "\n");
      return kDone;
    }
    studio::close_session(chosen, static_cast<std::uint64_t>(close_));
    print_json("{\"closed\":" + std::to_string(close_) + "}");
    say("closed     session " + std::to_string(close_) + "\n");
    return kDone;
  }

  void choose_folder() {
    config_.folder = fs::current_path();
    if (what_.empty()) return;
    const fs::path what = fs::absolute(what_).lexically_normal();
    const fs::path whole = what.has_filename() ? what : what.parent_path();
    if (!fs::exists(whole)) throw Error(printable(what_, 200) + ": no such file or folder");
    if (fs::is_directory(whole) && !fs::exists(whole / "recording.json")) {
      config_.folder = whole;
      return;
    }
    config_.folder = whole.parent_path();
    config_.open = whole.filename().string();
  }

  void print_address_json(const std::string& address) const {
    const std::string bare = address.substr(0, address.find("/#"));
    Json told;
    told["address"] = address;
    told["port"] = std::stoi(bare.substr(bare.rfind(':') + 1));
    print_json(told.dump());
  }

  void print_address(const std::string& address, bool is_open_to_others) const {
    print_address_json(address);
    say("studio     " + address + "\n");
    if (!is_open_to_others) return;
    say("           other machines that reach " + printable(config_.server.host) + " and have this address can use it" +
        (certificate_.empty() ? ", and it is not encrypted\n" : "\n"));
    say(config_.remote_force ? "           browsers may command forces, other machines' too (--remote-force)\n"
                             : "           forces are shown, not commanded; --remote-force allows it\n");
  }

  std::string what_;
  std::string certificate_, key_;
  bool list_ = false, new_token_ = false;
  int close_ = 0;
  bool no_open_ = false;
  studio::StudioConfig config_;
  studio::FeelConfig feel_;
};

}  // namespace

std::unique_ptr<Command> make_studio(Parser& root) { return std::make_unique<StudioCommand>(root); }

}  // namespace asperity::app
