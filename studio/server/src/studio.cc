#include "asperity/studio/studio.h"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "answer_control.h"
#include "asperity/base/host_clock.h"
#include "asperity/session/utc_now.h"
#include "asperity/studio/calls.h"
#include "control_socket.h"
#include "file_saver.h"
#include "folder_lock.h"
#include "home/recent_projects.h"
#include "inbox.h"
#include "losses.h"
#include "pages.h"

namespace asperity::studio {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTick = std::chrono::microseconds(33'333);
constexpr auto kSaveAfter = std::chrono::seconds(1);
constexpr const char* kDocumentFile = ".asperity-studio.json";

// The thread on which pages live: hears the browsers, ticks, keeps the document.
class Studio {
 public:
  explicit Studio(const StudioConfig& config)
      : config_(config),
        project_(config.folder),
        document_(project_.folder() / kDocumentFile),
        server_(start_server()),
        jobs_(std::make_unique<Jobs>(*server_, [this](Inbox::Work work) { inbox_.post(std::move(work)); })),
        shared_{*server_,
                project_,
                document_,
                *jobs_,
                lease_,
                is_this_machine_only(config.server.host) || config.remote_force,
                [this](Inbox::Work work) { inbox_.post(std::move(work)); },
                config.feel},
        pages_(make_pages(shared_, config.open, config.recent)),
        saver_(document_.file(),
               [this](std::string fault) { inbox_.post([this, fault = std::move(fault)] { cannot_save(fault); }); }) {
    shared_.report_loss = [this](const std::string& sentence) { losses_.add(sentence); };
    shared_.check_edit = [this](ClientId client, const Edit& edit) {
      for (const auto& page : pages_) page->check_edit(client, edit);
    };
    for (const auto& page : pages_) page->bind(document_, calls_);
    jobs_->bind(calls_);
    bind_sessions(calls_, *server_);
    document_.load();
    for (const std::string& problem : document_.problems()) notice(problem);
    document_.on_change([this](const Edit& edit) {
      for (const auto& page : pages_) page->edited(edit);
    });
    for (const auto& page : pages_) page->start();
    for (const std::string& warning : server_->warnings()) notice(warning);
    remember();
  }

  ~Studio() {
    for (const std::string& lost : close()) notice(lost);
  }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  std::string address() const { return server_->address(); }

  // Without a folder for its socket the studio runs all the same. Only after the address has been printed, so that what
  // is printed is the first token, never one that was renewed meanwhile.
  void open_control() {
    try {
      control_.emplace([this](const Json& request) {
        Json answer = answer_control(request, *server_, project_.folder());
        if (answer.contains("address") && !answer.contains("sessions")) {
          notice("the token was renewed; the earlier address and all sessions are no longer valid");
        }
        return answer;
      });
    } catch (const Error& error) {
      notice("--sessions and --new-token cannot reach this studio: " + std::string(error.what()));
    }
  }

  // What browsers have sent by now is done, and forces are at zero; then all is stored. Nothing that still waits may
  // run afterwards, for its pages are going. What could not be stored, in sentences; the second call has none.
  std::vector<std::string> close() noexcept {
    if (std::exchange(closed_, true)) return {};
    control_.reset();
    for (const Inbox::Work& work : inbox_.wait(Clock::now())) guarded(work);
    for (const auto& page : pages_) losses_.attempt("a page could not be ended", [&] { page->stop(); });
    guarded([this] { save(); });  // before what may take longer: a second signal ends the program at once
    losses_.attempt("the jobs could not be ended", [this] {
      for (const std::string& lost : jobs_->close()) losses_.add(lost);
    });
    inbox_.close();
    losses_.attempt("the server could not be ended", [this] { server_->stop(); });
    constexpr const char* kUnsaved = "the last changes of the project could not be saved";
    losses_.attempt(kUnsaved, [this] { save(); });
    if (const std::string fault = saver_.finish(); !fault.empty()) losses_.add(kUnsaved, fault);
    return losses_.take();
  }

  void run(const std::atomic<bool>& stop) {
    auto next = Clock::now();
    auto saved = next;
    while (!stop.load()) {
      for (const Inbox::Work& work : inbox_.wait(next)) guarded(work);
      const auto now = Clock::now();
      if (now < next) continue;
      // Ticks that were missed are not caught up with.
      next = now - next > kTick ? now + kTick : next + kTick;
      const std::int64_t now_ns = host_now_ns();
      for (const auto& page : pages_) guarded([&] { page->tick(now_ns); });
      if (now - saved >= kSaveAfter) {
        saved = now;
        guarded([this] { save(); });
      }
    }
  }

 private:
  void notice(const std::string& sentence) const {
    if (config_.notice) config_.notice(sentence);
  }

  // At the port of the last studio in this folder, so that pages which are open find this one; at another if that is
  // taken by now.
  std::unique_ptr<WebServer> start_server() {
    WebServerConfig server = config_.server;
    if (server.port != 0) return WebServer::start(server, events());
    server.port = remembered_port(config_.recent, project_.folder().string());
    try {
      return WebServer::start(server, events());
    } catch (const Error&) {
      if (server.port == 0) throw;
      return WebServer::start(config_.server, events());
    }
  }

  // Without it the next start has another port and one recent project is missing.
  void remember() {
    try {
      add_recent_project(config_.recent, {project_.folder().string(), utc_now(), server_->port()});
    } catch (const Error& error) {
      notice("the list of recent projects cannot be written: " + std::string(error.what()));
    }
  }

  WebServerEvents events() {
    WebServerEvents out;
    out.joined = [](ClientId) {};
    out.left = [this](ClientId client) {
      inbox_.post([this, client] {
        for (const auto& page : pages_) guarded([&] { page->client_left(client); });
      });
    };
    out.message = [this](ClientId client, Message message) {
      inbox_.post([this, client, message = std::move(message)] { hear(client, message); });
    };
    return out;
  }

  void hear(ClientId client, const Message& message) {
    if (const auto* call = std::get_if<Call>(&message)) {
      calls_.dispatch(Request(*server_, client, *call));
    } else {
      for (const auto& page : pages_) page->pointed(client, std::get<Pointer>(message));
    }
  }

  // One fault of one page must not end the others, nor a running force loop without its ramp.
  template <class Work>
  void guarded(const Work& work) noexcept {
    try {
      try {
        work();
      } catch (const Advice& advice) {
        note(advice.what(), advice.hint());
      } catch (const std::exception& error) {
        note(error.what(), "The studio continues. Try again.");
      }
    } catch (...) {
      // Not even the note could be sent.
    }
  }

  void note(const std::string& message, const std::string& hint) {
    server_->broadcast("note", Json{{"message", message}, {"hint", hint}});
  }

  void save() {
    if (std::optional<std::string> content = document_.take_unsaved()) {
      saver_.save(std::move(*content));
      save_failed_ = false;
    }
  }

  // A full disk must not end the studio: it is stated once, and tried again until it works (file_saver.h).
  void cannot_save(const std::string& fault) {
    if (std::exchange(save_failed_, true)) return;
    note("The studio's state cannot be saved: " + fault,
         "Free some space, or check that the folder is writable. Nothing is lost as long as the studio runs.");
  }

  StudioConfig config_;
  Losses losses_;
  Inbox inbox_;
  Project project_;
  FolderLock lock_{project_.folder()};
  Document document_;
  ForceLease lease_;
  Calls calls_;
  std::unique_ptr<WebServer> server_;
  std::unique_ptr<Jobs> jobs_;
  Shared shared_;
  std::vector<std::unique_ptr<Page>> pages_;
  bool save_failed_ = false;
  bool closed_ = false;
  FileSaver saver_;
  std::optional<ControlSocket> control_;
};

}  // namespace

void run_studio(const StudioConfig& config, const std::function<void(const std::string& address)>& started,
                const std::atomic<bool>& stop) {
  Studio studio(config);
  started(studio.address());
  studio.open_control();
  studio.run(stop);
  std::string all;
  for (const std::string& lost : studio.close()) all += (all.empty() ? "" : "\n") + lost;
  if (!all.empty()) throw Error(all);
}

}  // namespace asperity::studio
